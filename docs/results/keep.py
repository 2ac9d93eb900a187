"""Keeps what `make results` has run: the tables in the package, the figures and a page here."""

import shutil
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pandas as pd

from motionese.analysis import keep, kept_results, kept_runs
from motionese.analysis.beside_kept import beside_kept
from motionese.analysis.cells import NONE, Table
from motionese.analysis.comparison_page import groups
from motionese.analysis.mochizuki2013 import answer, findings
from motionese.analysis.mochizuki2013.findings import Finding
from motionese.analysis.page_tables import findings_rows

HERE = Path(__file__).parent
TABLES = HERE.parents[1] / "src" / "motionese" / "analysis" / "results"
FIGURES = (
    *("who_is_followed", "lesions", "symbols", "recall", "order_map", "order_decoded"),
    *("learning_curves", "new_sequences"),
)
"""Of every run folder's report, those that are kept."""
ABOUT = """# Kept results

What was measured in the confirming runs ([plan](../plan.md)). `make results` performs them again,
keeps their tables in the package (`src/motionese/analysis/results`, a row per condition and seed,
and `runs.json`: settings, seeds, version), the figures of their reports here, and writes this page.
`make reproduce` sets your own runs beside them.
"""


def main(run_folders: Sequence[Path], tables: Path, here: Path) -> None:
    """Keep the results of run folders."""
    keep(run_folders, tables)
    for folder in run_folders:
        for name in FIGURES:
            for file in (folder / "figures").glob(f"{name}.*"):
                (here / folder.name).mkdir(exist_ok=True)
                shutil.copyfile(file, here / folder.name / file.name)
    (here / "README.md").write_text("\n".join([*lines(here), ""]), encoding="utf-8")


def lines(here: Path) -> Iterator[str]:
    """Yield the lines of the page."""
    kept, runs = kept_results(), kept_runs()
    yield ABOUT
    if not kept:
        yield "Nothing is kept yet."
        return
    yield from (f"{sentence}\n" for sentence in answer(kept))
    yield "## Findings\n"
    yield from tested(findings(kept))
    for preset, measures in kept.items():
        seeds, version = runs[preset].seeds, runs[preset].version
        yield f"\n## {preset}\n"
        yield f"{len(seeds)} seeds, {seeds[0]}–{seeds[-1]}; motionese {version}. Medians [95 %].\n"
        yield from table(medians(measures))
        for name in FIGURES:
            if (here / preset / f"{name}.png").is_file():
                yield f"\n![{preset}: {name.replace('_', ' ')}]({preset}/{name}.png)"


def medians(measures: pd.DataFrame) -> Table:
    """Return every measure's median over seeds with its interval, a column per condition."""
    conditions = list(dict.fromkeys(measures["condition"]))
    rows = [
        [title, *(cell.kept or NONE for cell in cells)]
        for _, under in groups(beside_kept(measures, measures.iloc[:0]), conditions)
        for title, cells in under
    ]
    return Table(["measure", *conditions], rows)


def tested(found: Sequence[Finding]) -> Iterator[str]:
    """Yield the table of what was planned to be tested."""
    head, rows = findings_rows(found)
    yield from table(
        Table(head, [[f"{what}<br>{measured}", *row] for what, measured, *row in rows])
    )


def table(cells: Table) -> Iterator[str]:
    """Yield a table in Markdown."""
    for row in (cells.head, ["---"] * len(cells.head), *cells.rows):
        yield f"| {' | '.join(row)} |"


if __name__ == "__main__":
    main([Path(argument) for argument in sys.argv[1:]], TABLES, HERE)
