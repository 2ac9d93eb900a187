"""Writes the page on the experiments on motionese from the run folders of their arms."""

import sys
from collections.abc import Iterator
from pathlib import Path

import pandas as pd

from motionese.analysis.cells import with_interval
from motionese.analysis.motionese_arms import Arms, arm_findings, arm_table
from motionese.analysis.page_tables import findings_rows
from motionese.analysis.statistics import estimate

SHOWN = (
    *("separation", "first_by_cf", "order_by_cs", "order_by_cf", "untrained_cm"),
    *("untrained_repertoire_cm", "newborn_cm", "newborn_residual_cm", "loops_to_2_cm"),
    *("end_of_stage_2_cm", "pressed", "pauses_recall", "pauses_precision", "cf_recall"),
    *("cf_precision", "right_elements"),
)
ABOUT = """# The experiments on motionese

What was measured of the [plan](../plan_motionese.md). Medians over seeds, with intervals [95 %].
"""


def lines(arms: Arms) -> Iterator[str]:
    """Yield the lines of the page."""
    yield ABOUT
    yield "## Findings\n"
    head, rows = findings_rows(arm_findings(arms))
    yield from _table([*head], [[f"{what}<br>{measured}", *row] for what, measured, *row in rows])
    yield "\n## Arms\n"
    cells = [
        [name, str(len(table)), *(with_interval(estimate(_numbers(table, m))) for m in SHOWN)]
        for name, table in arms.items()
    ]
    yield from _table(["arm", "seeds", *SHOWN], cells)


def _numbers(table: pd.DataFrame, measure: str) -> "pd.Series[float]":
    return table.get(measure, pd.Series(dtype=float)).to_numpy(dtype=float)


def _table(head: list[str], rows: list[list[str]]) -> Iterator[str]:
    for cells in (head, ["---"] * len(head), *rows):
        yield f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    folders = sorted(path.parent for path in Path(sys.argv[1]).glob("*/measures.csv"))
    found = {folder.name: arm_table(folder) for folder in folders}
    page = Path(__file__).with_suffix(".md")
    page.write_text("\n".join([*lines(found), ""]), encoding="utf-8")
    pd.concat(found, names=["arm", "seed"]).to_csv(page.with_suffix(".csv"))
