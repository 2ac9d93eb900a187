"""What the settings change: every measure at a point against the reference, seed by seed."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from motionese.analysis.mochizuki2013.findings import Finding, PlannedTest, tested
from motionese.analysis.statistics import estimate
from motionese.analysis.sweep.points import Points

MEASURES = (
    *("separation", "first_by_cf", "order_by_cs", "map_length_1", "branch_without_cf"),
    *("end_of_stage_1_cm", "end_of_stage_2_cm", "end_of_stage_3_cm", "pressed"),
    *("untrained_cm", "untrained_repertoire_cm", "recall_ambiguous_2_cm"),
)
"""Columns that are followed over a sweep, where they have values."""
COLUMNS = [
    *("measure", "condition", "point", "median", "low", "high", "seeds"),
    *("difference", "difference_low", "difference_high", "p", "p_corrected", "verdict"),
]
WORDS = {"holds": "more", "does not hold": "less"}
"""Verdicts on a difference, which is larger at the point, or smaller."""


def swept_effects(points: Points, reference: str) -> pd.DataFrame:
    """Return a row per measure, condition and point.

    `median` with its interval `low`–`high` is over the seeds of the point; `difference` the mean of
    the paired differences to the reference with `difference_low` and `difference_high`, `p` and
    `p_corrected` (Holm, over the points of a measure and condition), and `verdict`: "more", "less"
    or "undecided with n seeds".
    """
    rows = []
    for measure, condition in _measured(points):
        values = {label: _values(points, label, condition, measure) for label in points}
        tests = [
            PlannedTest("", label, measure, own - values[reference])
            for label, own in values.items()
            if label != reference
        ]
        differences = {test.text: each for test, each in zip(tests, tested(tests), strict=True)}
        for label, own in values.items():
            middle = estimate(own.to_numpy(dtype=np.float64))
            who = {"measure": measure, "condition": condition, "point": label}
            found = dict(zip(["median", "low", "high", "seeds"], middle, strict=True))
            rows.append(who | found | _difference(differences.get(label)))
    return pd.DataFrame(rows, columns=COLUMNS)


def _difference(found: Finding | None) -> dict[str, Any]:
    if found is None:
        return {}
    return {
        "difference": found.statistic,
        "difference_low": found.low,
        "difference_high": found.high,
        "p": found.p,
        "p_corrected": found.p_corrected,
        "verdict": WORDS.get(found.verdict, found.verdict),
    }


def _measured(points: Points) -> Iterator[tuple[str, str]]:
    """Yield the measures and conditions that have values at two points at least."""
    together = pd.concat({label: found.measures for label, found in points.items()}, names=["at"])
    for measure in (m for m in MEASURES if m in together):
        for condition, own in together.groupby("condition", sort=False):
            if own[measure].dropna().index.unique("at").size > 1:
                yield measure, str(condition)


def _values(points: Points, label: str, condition: str, measure: str) -> "pd.Series[float]":
    """Return a measure at a point by seed."""
    table = points[label].measures
    own = table[table["condition"] == condition].set_index("seed")
    return own.reindex(columns=[measure])[measure].replace([np.inf, -np.inf], np.nan)
