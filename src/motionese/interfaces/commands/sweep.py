"""A sweep: a preset at several points of its settings, and one page of what holds where."""

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from rich.console import Console

from motionese.errors import SettingError
from motionese.experiment.run_folder import REPORT
from motionese.experiment.sweeps import SWEPT, Sweep, read_sweep, read_varied
from motionese.imitation import checked
from motionese.interfaces.commands.choices import read_seeds
from motionese.interfaces.commands.reproduce import perform
from motionese.interfaces.commands.results import write_all_results
from motionese.interfaces.commands.series import Asked, read_series
from motionese.interfaces.commands.workplace import Workplace


def sweep(
    console: Console,
    name: str | None,
    *,
    vary: Sequence[str],
    preset: str | None,
    conditions: Sequence[str],
    seeds: str,
    overrides: Iterable[str],
    out: Path | None,
    where: Workplace,
    quick: bool,
) -> str:
    """Go through a sweep's runs, or what is left of them, and report.

    Everything is checked before anything is written.

    Args:
        name: One that comes with motionese, or a TOML file; None for what `vary` says.
        preset: In the place of the sweep's.
        conditions: In the place of the sweep's.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        UnfinishedRunsError: Runs that could not go on; the others were finished and reported.
    """
    numbers, asked = read_seeds(seeds), _asked(name, vary, preset, conditions)
    root = out or Path("runs") / (f"sweep-{_called(name, asked)}" + ("-quick" if quick else ""))
    same = list(overrides)
    points = [Asked(asked.preset, [*same, *p.overrides], p.label) for p in asked.points]
    series = read_series(
        root, points, conditions=asked.conditions, quick=quick, kind="point of the sweep"
    )
    return perform(
        console,
        root,
        series,
        numbers,
        where,
        lambda folders: write_all_results(folders, root / REPORT, console),
        beside={SWEPT: asked.model_dump_json(indent=1)},
    )


def _asked(
    name: str | None, vary: Sequence[str], preset: str | None, conditions: Sequence[str]
) -> Sweep:
    """Return the sweep that is asked for, after what the command line says instead of it."""
    if (name is None) == (not vary):
        raise SettingError(
            "name one sweep (`motionese sweep` alone lists those that there are) or say with "
            "--vary NAME=NUMBER,NUMBER … what is varied"
        )
    given: dict[str, Any] = {"preset": preset, "conditions": tuple(conditions)}
    given = {option: value for option, value in given.items() if value}
    if name is None:
        return checked(Sweep, {"vary": read_varied(vary), **given})
    return read_sweep(name).model_copy(update=given)


def _called(name: str | None, asked: Sweep) -> str:
    """Return what a sweep's folder is called."""
    return Path(name).stem if name else "-".join(each.rpartition(".")[2] for each in asked.vary)
