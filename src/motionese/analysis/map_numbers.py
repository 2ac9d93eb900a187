"""The map of the slow initial states in numbers, beside what became of the slow level's weights."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from motionese.analysis.directions import (
    direction_shares,
    following,
    resultant_length,
    share_within,
)
from motionese.experiment.conditions import CONDITIONS

SEGMENTS = (1, 2)
"""The first segment is the primitive whose Cf_0 is held, the second the one that follows it."""
UNMOVED = 0.1
"""Weights whose rms changed by less than this share have hardly moved."""
NOTHING = 0.05
"""A level that takes part in less than this share of the direction's variance does nothing."""
COLUMNS = [
    "condition",
    "seed",
    *(
        f"{name}_{segment}"
        for segment in SEGMENTS
        for name in (
            "resultant_length",
            "within_45",
            "share_cf",
            "share_cs",
            "share_together",
            "extent_rad",
        )
    ),
    "rms_cs_to_cf_before",
    "rms_cs_to_cf_after",
]


def map_numbers(
    points: pd.DataFrame, development: pd.DataFrame, strokes: Mapping[str, tuple[float, float]]
) -> pd.DataFrame:
    """Return a row of numbers for each condition and seed that has a map.

    Args:
        points: The map, a row per condition, seed, primitive and grid point.
        development: A row per loop on the network.
        strokes: Every primitive's true direction [rad] and extent [rad].

    Returns:
        Resultant length and share within 45°, averaged over the primitives; shares of the
        direction's variance; median extent [rad]; the Cs→Cf weights' rms when learning with them
        began and when it ended. Columns ending in _1 and _2 are of the first and second segment.
    """
    rows = []
    for condition in CONDITIONS:
        for seed in sorted(set(points.loc[points["condition"] == condition.name, "seed"])):
            own = (points["condition"] == condition.name) & (points["seed"] == seed)
            row: dict[str, Any] = {"condition": condition.name, "seed": seed}
            for segment in SEGMENTS:
                row |= _segment(points[own], segment, strokes)
            row |= _weights(development, condition.name, seed)
            rows.append(row)
    return pd.DataFrame(rows, columns=COLUMNS)


def _segment(
    points: pd.DataFrame, segment: int, strokes: Mapping[str, tuple[float, float]]
) -> dict[str, float]:
    table = points.pivot_table(
        index="primitive", columns=["cs_1", "cs_2"], values=f"direction_{segment}_rad", sort=True
    )
    directions = table.to_numpy(dtype=np.float64)
    names = [str(name) for name in table.index]
    right = [(name,) if segment == 1 else following(name) for name in names]
    shares = direction_shares(directions)
    within = [
        share_within(row, [strokes[name][0] for name in allowed])
        for row, allowed in zip(directions, right, strict=True)
    ]
    return {
        f"resultant_length_{segment}": float(resultant_length(directions).mean()),
        f"within_45_{segment}": float(np.mean(within)),
        f"share_cf_{segment}": shares.by_cf,
        f"share_cs_{segment}": shares.by_cs,
        f"share_together_{segment}": shares.together,
        f"extent_rad_{segment}": float(points[f"extent_{segment}_rad"].median()),
    }


def _weights(development: pd.DataFrame, condition: str, seed: int) -> dict[str, float]:
    own = development[(development["condition"] == condition) & (development["seed"] == seed)]
    last = own.sort_values("loop").tail(1)
    values = {
        "rms_cs_to_cf_before": "rms_cs_to_cf_at_opening",
        "rms_cs_to_cf_after": "rms_cs_to_cf",
    }
    return {
        name: float(last[column].iloc[0]) if column in last and len(last) else np.nan
        for name, column in values.items()
    }


def warnings(numbers: pd.DataFrame) -> list[str]:
    """Return a sentence for the conditions whose maps must not be taken for what was learned."""
    idle: list[str] = []
    as_drawn: list[str] = []
    for condition in CONDITIONS:
        own = numbers[numbers["condition"] == condition.name]
        if own.empty:
            continue
        middle = own.drop(columns="condition").median()
        before, after = middle["rms_cs_to_cf_before"], middle["rms_cs_to_cf_after"]
        if not abs(after - before) < UNMOVED * before:
            continue
        parts = [1 - middle[f"share_cf_{segment}"] for segment in SEGMENTS]
        said = f"{condition.name} ({before:.2f} → {after:.2f}; {parts[0]:.1%} and {parts[1]:.1%})"
        (idle if max(parts) < NOTHING else as_drawn).append(said)
    sentences = []
    if idle:
        sentences.append(
            f"The slow level does nothing in {listed(idle)}: its weights to Cf hardly moved in "
            "learning, and a map over it proves nothing."
        )
    if as_drawn:
        sentences.append(
            f"The map shows the slow level as it was drawn at random in {listed(as_drawn)}: its "
            "weights to Cf hardly moved in learning."
        )
    if sentences:
        sentences[-1] += (
            " (In brackets: the rms of those weights before and after; the share of the variance "
            "of the first and of the second segment's direction that Cs₀ takes part in.)"
        )
    return sentences


def listed(names: Sequence[str]) -> str:
    """Return names as a list in words."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
