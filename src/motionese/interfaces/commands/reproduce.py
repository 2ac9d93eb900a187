"""Performing the experiment: check everything, go through all runs, report."""

from collections.abc import Iterable, Sequence
from pathlib import Path

from dask.system import CPU_COUNT
from rich.console import Console

from motionese.caregiver import Recorded, read_recorded
from motionese.errors import SettingError
from motionese.experiment import Run, Study, read_settings
from motionese.experiment.many_runs import UnfinishedRunsError, go_through_all
from motionese.experiment.run_folder import REPORT, open_run_folder
from motionese.imitation import Scene, newborn
from motionese.interfaces.commands.choices import as_ranges, read_conditions, read_seeds
from motionese.interfaces.commands.display import Display
from motionese.interfaces.commands.results import write_results

SCRIPTED = "scripted"


def reproduce(
    console: Console,
    *,
    conditions: Iterable[str],
    seeds: str,
    preset: str,
    overrides: Iterable[str],
    out: Path | None,
    workers: int | None,
    quick: bool,
    caregiver: str = SCRIPTED,
) -> str:
    """Perform the experiment, or what is left of it, and report.

    Everything is checked before anything is written.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        UnfinishedRunsError: Runs that could not go on; the others were finished and reported.
    """
    settings = read_settings(preset, overrides, quick=quick)
    scene = Scene(settings, seed=0)
    newborn(scene, len(settings.network.levels))
    chosen, numbers = read_conditions(conditions, settings), read_seeds(seeds)
    shown = _recorded(caregiver, scene)
    path = out or Path("runs") / (Path(preset).stem + ("-quick" if quick else ""))
    say = console.print
    with open_run_folder(path, settings, preset, shown.digest if shown else "") as folder:
        runs = [folder.run(condition, seed) for seed in numbers for condition in chosen]
        say(f"The report will be at {path / REPORT}")
        names = ", ".join(c.name for c in chosen)
        say(f"{len(runs)} runs: {names}, each with seeds {as_ranges(numbers)}")
        if shown:
            say(f"Recorded demonstrations of {', '.join(shown.recordings)}; the rest scripted")
        for change in folder.changed:
            say(f"This folder was begun with other versions ({change}): the bits may differ")
        failures = _go_through(runs, settings, workers or CPU_COUNT, shown, console)
        if failures and not any(run.ended() for run in runs):
            raise UnfinishedRunsError("; ".join(failures))
        too_few = write_results(path, console)
    diverged = [run.name for run in runs if (run.ended() or {}).get("status") == "diverged"]
    if diverged:
        names = ", ".join(diverged)
        say(f"{len(diverged)} of {len(runs)} runs diverged: {names}; see the report")
    if failures:
        raise UnfinishedRunsError("; ".join(failures))
    return too_few


def _recorded(caregiver: str, scene: Scene) -> Recorded | None:
    """Return the demonstrations of 'recordings:PATH', or None for 'scripted'."""
    kind, _, path = caregiver.partition(":")
    if caregiver == SCRIPTED:
        return None
    if kind != "recordings" or not path:
        raise SettingError(f"--caregiver is {SCRIPTED} or recordings:FOLDER, got '{caregiver}'")
    return read_recorded(Path(path), scene.task, scene.settings.caregiver, scene.body)


def _go_through(
    runs: Sequence[Run], settings: Study, workers: int, shown: Recorded | None, console: Console
) -> list[str]:
    left = [run for run in runs if not run.ended()]
    loops = settings.most_loops()
    begun = sum(run.loops_done() > 0 for run in left)
    if len(left) < len(runs) or begun:
        console.print(f"{len(runs) - len(left)} of them are done, {begun} go on from a checkpoint")
    if not left:
        return []
    workers = min(workers, len(left))
    stops = "Ctrl-C stops, the same command goes on"
    console.print(f"{loops} loops a run, {workers} at a time; {stops}")
    with Display(console, runs, loops) as display:
        return go_through_all(
            left,
            settings,
            workers,
            recordings=shown.recordings if shown else None,
            loop_done=display.loop_done,
            run_ended=display.run_ended,
        )
