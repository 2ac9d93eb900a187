"""The report of a run folder, and its results in a few lines."""
# ruff: noqa: PLC0415

from pathlib import Path
from typing import TYPE_CHECKING

from rich.console import Console
from rich.table import Table

from motionese.experiment.conditions import CONDITIONS
from motionese.experiment.run_folder import run_settings

if TYPE_CHECKING:
    import pandas as pd


def write_results(folder: Path, console: Console) -> str:
    """Write the report; print where it is, and the results.

    Returns:
        Why there was too little for a statistical test, or "".

    Raises:
        RunFolderError: No run folder, or none of its runs has ended.
    """
    settings = run_settings(folder)
    # A second of imports that nobody who is told of a mistake should wait for.
    from motionese.analysis import write_report

    with console.status("Writing the report …"):
        written = write_report(folder)
    console.print(summary(written.path.parent, settings["phases"]["change_after"]))
    console.print(f"Report: {written.path}")
    return str(written.too_few)


def summary(folder: Path, change_after: int) -> Table:
    """Return imitation errors [cm], median over seeds, and how many due buttons were pressed.

    Args:
        folder: Where `loops.csv` and `triples.csv` are.
        change_after: The last loop of phase 1.
    """
    import pandas as pd

    loops = pd.read_csv(folder / "loops.csv")
    novel = folder / "triples.csv"
    triples = pd.read_csv(novel) if novel.is_file() else pd.DataFrame()
    last = int(loops["loop"].max())
    shown = sorted({1, min(max(change_after, 1), last), last})
    columns = (*(f"loop {n}" for n in shown), "untrained triples", f"buttons, loop {last}")
    table = Table("condition", "seeds", *columns)
    table.title = "Imitation error [cm], mean over motions, median over seeds"
    for column in table.columns[1:]:
        column.justify = "right"
    for name in (c.name for c in CONDITIONS):
        own = loops[loops["condition"] == name]
        if own.empty:
            continue
        errors = [_centimetres(own[own["loop"] == n]) for n in shown]
        at_last = own[own["loop"] == last]
        table.add_row(
            name,
            str(own["seed"].nunique()),
            *errors,
            _untrained(triples, name),
            _of(int(at_last["buttons_pressed"].sum()), int(at_last["buttons_due"].sum())),
        )
    return table


def _centimetres(rows: "pd.DataFrame") -> str:
    """Return the median over seeds of each seed's mean over motions."""
    if rows.empty:
        return "–"
    return f"{rows.groupby('seed')['imitation_error_cm'].mean().median():.1f}"


def _untrained(triples: "pd.DataFrame", name: str) -> str:
    if triples.empty:
        return "–"
    return _centimetres(triples[(triples["condition"] == name) & ~triples["trained"]])


def _of(pressed: int, due: int) -> str:
    return f"{pressed} of {due}" if due else "–"
