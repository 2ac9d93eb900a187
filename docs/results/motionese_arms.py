"""Writes the page on the experiments on motionese from the run folders of their arms.

    python docs/results/motionese_arms.py runs/motionese

Arms that were run elsewhere stay as the table beside the page keeps them.
"""

import re
import sys
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
from keep import table, tested

from motionese.analysis.cells import Table, with_interval
from motionese.analysis.motionese_arms import Arms, arm_findings, arm_table
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
PLAN = Path(__file__).parents[1] / "plan_motionese.md"
LEFT_OUT = {"straightness"}
"""Of the plan: ways are straight in this task, and it changes nothing."""


def lines(arms: Arms) -> Iterator[str]:
    """Yield the lines of the page."""
    yield ABOUT
    planned = re.findall(
        r"^ {4}motionese .*--out runs/motionese/(\S+)", PLAN.read_text("utf-8"), re.M
    )
    if missing := [arm for arm in planned if arm not in arms and arm not in LEFT_OUT]:
        yield (
            f"Not run yet, of {len(planned)} arms: {', '.join(missing)}. Tests that need them are "
            "missing below, and those of their families are corrected for the tests that are there "
            "alone: verdicts of such a family are provisional.\n"
        )
    yield "## Findings\n"
    yield from tested(arm_findings(arms))
    yield "\n## Arms\n"
    cells = [
        [name, str(len(arm)), *(with_interval(estimate(_numbers(arm, m))) for m in SHOWN)]
        for name, arm in arms.items()
    ]
    yield from table(Table(["arm", "seeds", *SHOWN], cells))


def _numbers(arm: pd.DataFrame, measure: str) -> "pd.Series[float]":
    return arm.get(measure, pd.Series(dtype=float)).to_numpy(dtype=float)


def kept_arms(file: Path) -> Arms:
    """Return the arms of the table beside the page, none if there is no such table."""
    if not file.is_file():
        return {}
    together = pd.read_csv(file, index_col=["arm", "seed"])
    return {
        name: rows.droplevel("arm").dropna(axis="columns", how="all")
        for name, rows in together.groupby("arm")
    }


def in_order(name: str) -> tuple[str, int, str]:
    """Return what arms are sorted by: free-2 comes before free-12."""
    sharing, _, rest = name.partition("-")
    steps, _, more = rest.partition("-")
    return (sharing, int(steps), more) if steps.isdigit() else (sharing, 1000, rest)


if __name__ == "__main__":
    page = Path(__file__).with_suffix(".md")
    run_folders = [path.parent for path in Path(sys.argv[1]).glob("*/measures.csv")]
    found = kept_arms(page.with_suffix(".csv")) | {f.name: arm_table(f) for f in run_folders}
    arms = {name: found[name] for name in sorted(found, key=in_order)}
    page.write_text("\n".join([*lines(arms), ""]), encoding="utf-8")
    together = pd.concat(arms, names=["arm", "seed"])
    together.to_csv(page.with_suffix(".csv"), float_format="%.6g", lineterminator="\n")
