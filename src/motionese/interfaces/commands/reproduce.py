"""Performing the experiment: check everything, go through all runs, report."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType

from rich.console import Console

from motionese.experiment.many_runs import Job, UnfinishedRunsError, go_through_all
from motionese.experiment.run_folder import REPORT, RunFolder, check_around, open_run_folders
from motionese.files import write_whole
from motionese.interfaces.commands.choices import as_ranges, read_seeds
from motionese.interfaces.commands.display import Display
from motionese.interfaces.commands.results import write_all_results, write_results
from motionese.interfaces.commands.series import SCRIPTED, Series, read_presets, read_series
from motionese.interfaces.commands.workplace import Workplace


def reproduce(
    console: Console,
    *,
    conditions: Iterable[str],
    seeds: str,
    presets: Sequence[str],
    overrides: Iterable[str],
    out: Path | None,
    where: Workplace,
    quick: bool,
    caregiver: str = SCRIPTED,
) -> str:
    """Perform the experiment with every preset, or what is left of it, and report.

    Everything is checked before anything is written.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        UnfinishedRunsError: Runs that could not go on; the others were finished and reported.
    """
    numbers = read_seeds(seeds)
    root, asked = read_presets(presets, list(overrides), out, quick=quick)
    series = read_series(root, asked, conditions=conditions, quick=quick, caregiver=caregiver)

    def written(folders: Sequence[Path]) -> str:
        if len(series) > 1:
            return write_all_results(folders, root / REPORT, console)
        return write_results(root, console)

    return perform(console, root, series, numbers, where, written)


def perform(
    console: Console,
    root: Path,
    series: Sequence[Series],
    seeds: Sequence[int],
    where: Workplace,
    written: Callable[[Sequence[Path]], str],
    *,
    beside: Mapping[str, str] = MappingProxyType({}),
) -> str:
    """Go through all runs, or what is left of them, and report.

    Args:
        root: The folder of everything.
        written: Writes the report of those run folders that have a run that ended, and returns why
            there was too little for a statistical test.
        beside: What is written into `root` before the runs, by the names of files.

    Raises:
        UnfinishedRunsError: Runs that could not go on; the others were finished and reported.
    """
    if root not in [each.path for each in series]:
        check_around(root, [*beside, *(each.label for each in series)])
    with open_run_folders([each.opening for each in series], where.shard) as folders:
        for name, text in beside.items():
            write_whole(root / name, text)
        jobs = {s.path: s.jobs(f, seeds) for s, f in zip(series, folders, strict=True)}
        every = [job for each in jobs.values() for job in each]
        if not where.shard:
            console.print(f"The report will be at {root / REPORT}")
        for each, folder in zip(series, folders, strict=True):
            _say_what(each, folder, seeds, console)
        if where.shard:
            return _shard_done(every, where, root, console)
        failures = _go_through(every, where, console)
        ended = [path for path, own in jobs.items() if any(job.run.ended() for job in own)]
        if not ended:
            raise UnfinishedRunsError("; ".join(failures))
        too_few = written(ended)
    _say_diverged(every, console)
    if failures:
        raise UnfinishedRunsError("; ".join(failures))
    return too_few


def _shard_done(every: Sequence[Job], where: Workplace, root: Path, console: Console) -> str:
    """Do the runs of a shard; their report is written when all have ended."""
    assert where.shard is not None
    own = where.shard.part(every)
    console.print(f"Shard {where.shard}: {len(own)} of {len(every)} runs")
    failures = _go_through(own, where, console)
    _say_diverged(own, console)
    if failures:
        raise UnfinishedRunsError("; ".join(failures))
    console.print(f"When all shards have ended, `motionese report {root}` writes the report")
    return ""


def _say_diverged(jobs: Sequence[Job], console: Console) -> None:
    diverged = [job.name for job in jobs if (job.run.ended() or {}).get("status") == "diverged"]
    if diverged:
        told = f"{len(diverged)} of {len(jobs)} runs diverged: {', '.join(diverged)}"
        console.print(f"{told}; see the report")


def _say_what(series: Series, folder: RunFolder, numbers: Sequence[int], console: Console) -> None:
    names, of = ", ".join(c.name for c in series.conditions), series.label and f" of {series.label}"
    count, say = len(series.conditions) * len(numbers), console.print
    say(f"{count} runs{of}: {names}, each with seeds {as_ranges(numbers)}")
    if shown := series.shown:
        say(f"Recorded demonstrations of {', '.join(shown.recordings)}; the rest scripted")
        for episode in shown.skipped:
            say(f"Skipped: episode {episode}")
    for change in folder.changed:
        this = f"{folder.path}" if of else "This folder"
        say(f"{this} was begun with other versions ({change}): the bits may differ")


def _go_through(jobs: Sequence[Job], where: Workplace, console: Console) -> list[str]:
    left = [job for job in jobs if not job.run.ended()]
    begun = sum(job.run.loops_done() > 0 for job in left)
    if len(left) < len(jobs) or begun:
        console.print(f"{len(jobs) - len(left)} of them are done, {begun} go on from a checkpoint")
    if not left:
        return []
    loops = sorted({job.loops for job in left})
    stops = "Ctrl-C stops, the same command goes on"
    console.print(f"{_range(loops)} loops a run, {where.told(len(left))}; {stops}")
    with Display(console, jobs) as display:
        return go_through_all(
            left,
            where.workers(left, display.say),
            loop_done=display.loop_done,
            run_ended=display.run_ended,
        )


def _range(loops: Sequence[int]) -> str:
    return " to ".join(dict.fromkeys(map(str, (loops[0], loops[-1]))))
