"""The report of one run folder or of several, and their results in a few lines."""
# ruff: noqa: PLC0415

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table

from motionese.errors import RunFolderError
from motionese.experiment import Study
from motionese.experiment.presets import study_of
from motionese.experiment.run_folder import REPORT, SETTINGS, run_folders_in, run_settings
from motionese.experiment.sweeps import sweep_in
from motionese.task import Outcome

if TYPE_CHECKING:
    import pandas as pd


def write_results(folder: Path, console: Console) -> str:
    """Write the report; print where it is, and the results.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        RunFolderError: No run folder, or none of its runs has ended.
    """
    study = study_of(run_settings(folder))
    # A second of imports that nobody who is told of a mistake should wait for.
    from motionese.analysis import write_report

    with console.status("Writing the report …"):
        written = write_report(folder)
    for path in written.unlike:
        console.print(f"{path} had changed since it was written; it is written anew.")
    console.print(summary(written.path.parent, study))
    console.print(f"Report: {written.path}")
    return str(written.too_few)


def write_again(paths: Sequence[Path], out: Path | None, console: Console) -> str:
    """Write the report of one run folder; or those of several, and one for all of them.

    Args:
        paths: Run folders, and folders that run folders lie in.
        out: Where the one report is written; None for `report.html` in the folder around them.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        RunFolderError: No run folder, or there is no place for the one report.
    """
    nested = {path: not (path / SETTINGS).exists() and run_folders_in(path) for path in paths}
    folders = [each for path, within in nested.items() for each in within or [path]]
    if out is None and folders == list(nested) and len(folders) == 1:
        return write_results(folders[0], console)
    for folder in folders:
        run_settings(folder)
    around = folders[0].parent
    if out is None and {each.resolve().parent for each in folders} != {around.resolve()}:
        raise RunFolderError(
            "these run folders do not lie in one folder; say with --out FILE where their report "
            "is written"
        )
    return write_all_results(folders, out or around / REPORT, console)


def write_all_results(folders: Sequence[Path], path: Path, console: Console) -> str:
    """Write the report of every run folder, and one for all of them; print their results.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        RunFolderError: No run folder, none of its runs has ended, or it is no place for a report.
    """
    from motionese.analysis import write_comparison, write_sweep

    if path.is_dir() or (path.parent / SETTINGS).exists():
        what = "is a folder" if path.is_dir() else "would lie in a run folder, which has its own"
        raise RunFolderError(f"{path} {what}; the one report needs another place")
    reasons = []
    for folder in folders:
        console.print(f"{folder}:")
        if too_few := write_results(folder, console):
            reasons.append(f"{folder}: {too_few}")
    with console.status("Writing the report of all …"):
        around = {folder.resolve().parent for folder in folders}
        if len(around) == 1 and (swept := sweep_in(around.pop())):
            write_sweep(swept, folders, path)
        else:
            write_comparison(folders, path)
    console.print(f"Report of all: {path}")
    return "; ".join(reasons)


def summary(folder: Path, study: Study) -> Table:
    """Return imitation errors [cm], median over seeds, and what was achieved in the last loop.

    They are made of `loops.csv` and the tables of new sequences in a folder of such runs.
    """
    import pandas as pd

    task = study.task.task()
    loops = pd.read_csv(folder / "loops.csv")
    novel = {name: folder / f"{name}.csv" for name in task.novel}
    tables = {name: pd.read_csv(path) for name, path in novel.items() if path.is_file()}
    stages = range(1, len(study.stages) + 1)
    columns = [f"stage {n}" for n in stages]
    columns += [f"new {name.removeprefix('new_')}" for name in tables]
    outcome = task.outcomes[0]
    table = Table("condition", "seeds", "loop 1", *columns, f"{outcome.title}, last loop")
    table.title = (
        "Imitation error [cm] in loop 1, in the last loop of every stage, and of new sequences; "
        "mean over motions, median over seeds"
    )
    for column in table.columns[1:]:
        column.justify = "right"
    for condition in study.conditions:
        own = loops[loops["condition"] == condition.name]
        if own.empty:
            continue
        errors = [_centimetres(own[own["loop"] == 1])]
        errors += [_centimetres(_last_loop(own[own["phase"] == n])) for n in stages]
        for rows in tables.values():
            untrained = ~rows["trained"].astype(bool)
            errors.append(_centimetres(rows[untrained & (rows["condition"] == condition.name)]))
        seeds, achieved = str(own["seed"].nunique()), _achieved(_last_loop(own), outcome)
        table.add_row(condition.name, seeds, *errors, achieved)
    return table


def _last_loop(rows: "pd.DataFrame") -> "pd.DataFrame":
    """Return the rows of every seed's last loop."""
    return rows[rows["loop"] == rows.groupby("seed")["loop"].transform("max")]


def _centimetres(rows: "pd.DataFrame") -> str:
    """Return the median over seeds of each seed's mean over motions."""
    if rows.empty:
        return "–"
    return f"{rows.groupby('seed')['imitation_error_cm'].mean().median():.1f}"


def _achieved(rows: "pd.DataFrame", outcome: Outcome) -> str:
    if not outcome.of:
        return f"{rows[outcome.column].median():.1f} {outcome.unit}"
    done, due = int(rows[outcome.column].sum()), int(rows[outcome.of].sum())
    return f"{done} of {due}" if due else "–"
