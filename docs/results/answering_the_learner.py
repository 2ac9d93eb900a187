"""Writes the page on change that answers the learner from run folders that were reported on.

    python docs/results/answering_the_learner.py runs/adaptive runs/scaffolding runs/four_levels

Presets that were run elsewhere stay as the tables beside the page keep them.
"""

import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pandas as pd
from keep import table, tested

from motionese.analysis.cells import Table, with_interval
from motionese.analysis.changes import changes_table
from motionese.analysis.planned_changes import planned_findings
from motionese.analysis.reported import read_reported
from motionese.analysis.statistics import estimate
from motionese.experiment import Study, read_settings

TITLES = {
    "adaptive": "When lesson and network change",
    "scaffolding": "What is shown next",
    "four_levels": "A fourth level",
}
FIGURES = ("changes", "who_is_followed", "learning_curves")
TABLES = ("measures.csv", "changes.csv")
SHOWN = (
    *("end_of_stage_1_cm", "end_of_stage_2_cm", "end_of_stage_3_cm", "untrained_cm"),
    *("separation", "first_by_cf", "order_by_cs", "order_by_cf", "pressed"),
)
ABOUT = """# Change that answers the learner

What was measured of the [plan](../plan_adaptive.md), on seeds that nothing was chosen on. A
difference is positive where it speaks for the finding; intervals are 95 % over seeds; p is
corrected (Holm) within a family of tests.
"""


def lines(kept: Path) -> Iterator[str]:
    """Yield the lines of the page from what is kept."""
    yield ABOUT
    for preset, title in TITLES.items():
        if not (kept / preset).is_dir():
            continue
        study = read_settings(preset)
        measures = pd.read_csv(kept / preset / "measures.csv")
        file = kept / preset / "changes.csv"
        changed = pd.read_csv(file) if file.is_file() else None
        seeds = sorted(set(measures["seed"]))
        yield f"## {title}\n"
        yield f"Preset `{preset}`, {len(seeds)} seeds, {seeds[0]}–{seeds[-1]}.\n"
        yield from tested(planned_findings(study, measures, changed))
        for name in FIGURES:
            if (kept / preset / f"{name}.png").is_file():
                yield f"\n![{title}: {name.replace('_', ' ')}]({kept.name}/{preset}/{name}.png)"
        if changed is not None:
            yield "\n*When things changed: medians, with the smallest and the largest value.*\n"
            yield from table(changes_table(changed, [c.name for c in study.conditions]))
        yield "\n*Measures: medians [95 %].*\n"
        yield from table(_medians(study, measures))
        yield ""


def _medians(study: Study, measures: pd.DataFrame) -> Table:
    shown = [name for name in SHOWN if name in measures and measures[name].notna().any()]
    rows = []
    for name in (condition.name for condition in study.conditions):
        own = measures[measures["condition"] == name]
        values = [estimate(own[measure].to_numpy(dtype=float)) for measure in shown]
        rows.append([name, *map(with_interval, values)])
    return Table(["condition", *shown], rows)


if __name__ == "__main__":
    kept = Path(__file__).with_suffix("")
    for folder in map(Path, sys.argv[1:]):
        place = kept / read_reported(folder).preset
        place.mkdir(parents=True, exist_ok=True)
        for file in (folder / name for name in TABLES if (folder / name).is_file()):
            rows = pd.read_csv(file)
            rows.to_csv(place / file.name, index=False, float_format="%.6g", lineterminator="\n")
        for file in (folder / "figures" / f"{name}.png" for name in FIGURES):
            if file.is_file():
                shutil.copyfile(file, place / file.name)
    kept.with_suffix(".md").write_text("\n".join(lines(kept)), encoding="utf-8")
