"""Which findings hold at which point: the tests of a preset's plan, made anew at every point."""

import pandas as pd

from motionese.analysis import mochizuki2013
from motionese.analysis.mochizuki2013.findings import Finding
from motionese.analysis.planned_changes import planned_findings
from motionese.analysis.sweep.points import Points

CHANGES = "changes.csv"


def swept_findings(preset: str, points: Points) -> pd.DataFrame:
    """Return a row per finding and point: what `Finding` tells, and the `point`.

    Tests are corrected within their families at each point. Those of a study's design need all of
    its conditions.
    """
    rows = []
    for label, found in points.items():
        tested: list[Finding] = []
        whole = set(found.measures["condition"]) == {c.name for c in found.study.conditions}
        if whole and mochizuki2013.has_its_design(found.study):
            tested = mochizuki2013.findings({preset: found.measures})
        changes = found.folder / CHANGES
        changed = pd.read_csv(changes) if changes.is_file() else None
        tested += planned_findings(found.study, found.measures, changed) if whole else []
        rows += [{"point": label, **each._asdict()} for each in tested if each.seeds]
    return pd.DataFrame(rows, columns=["point", *Finding._fields])
