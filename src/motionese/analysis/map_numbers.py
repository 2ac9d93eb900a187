"""The map of the slow initial states in numbers, beside what became of the slow level's weights."""

from collections.abc import Collection, Mapping
from typing import Any

import numpy as np
import pandas as pd

from motionese.analysis.cells import listed
from motionese.analysis.directions import (
    direction_shares,
    following,
    resultant_length,
    share_within,
)
from motionese.experiment import Study
from motionese.task import Task

Strokes = Mapping[str, tuple[float, float]]
"""Every primitive's true direction [rad] and extent [rad]."""

SEGMENTS = (1, 2)
"""The first segment is the primitive whose Cf_0 is held, the second the one that follows it."""
UNMOVED = 0.1
"""Weights whose rms changed by less than this share have hardly moved."""
NOTHING = 0.05
"""A level that takes part in less than this share of the direction's variance does nothing."""


def map_numbers(
    points: pd.DataFrame, development: pd.DataFrame, study: Study, strokes: Strokes
) -> pd.DataFrame:
    """Return a row of numbers for each condition and seed that has a map.

    Resultant length and share within 45°, averaged over the primitives; shares of the direction's
    variance; median extent [rad]; the rms of the weights from the top level to the one below when
    learning with them began and when it ended. Columns ending in _1 and _2 are of the first and
    second segment.
    """
    task, names = study.task.task(), level_names(study)
    rows = []
    for condition in study.conditions:
        of = points["condition"] == condition.name
        for seed in sorted(set(points.loc[of, "seed"])):
            own = points[of & (points["seed"] == seed)]
            row: dict[str, Any] = {"condition": condition.name, "seed": seed}
            for segment in SEGMENTS:
                row |= _segment(own, segment, names, task, strokes)
            rows.append(row | _weights(development, condition.name, seed, names))
    return pd.DataFrame(rows, columns=None if rows else _columns(*names))


def level_names(study: Study) -> tuple[str, str]:
    """Return the names of the level below the top one, and of the top one."""
    *_, below, top = study.network.levels
    return below, top


def _columns(below: str, top: str) -> list[str]:
    shares = [f"share_{name}" for name in (below, top, "together")]
    measured = ["resultant_length", "within_45", "extent_rad", *shares]
    block = [f"rms_{top}_to_{below}_{when}" for when in ("before", "after")]
    return ["condition", "seed", *(f"{name}_{i}" for i in SEGMENTS for name in measured), *block]


def _segment(
    points: pd.DataFrame, segment: int, names: tuple[str, str], task: Task, strokes: Strokes
) -> dict[str, float]:
    below, top = names
    grid = [f"{top}_1", f"{top}_2"]
    table = points.pivot_table(f"direction_{segment}_rad", index="primitive", columns=grid)
    directions = table.to_numpy(dtype=np.float64)
    right = [(name,) if segment == 1 else following(task, name) for name in map(str, table.index)]
    shares = direction_shares(directions)
    within = [
        share_within(row, [strokes[name][0] for name in allowed])
        for row, allowed in zip(directions, right, strict=True)
    ]
    return {
        f"resultant_length_{segment}": float(resultant_length(directions).mean()),
        f"within_45_{segment}": float(np.mean(within)),
        f"share_{below}_{segment}": shares.by_held,
        f"share_{top}_{segment}": shares.by_varied,
        f"share_together_{segment}": shares.together,
        f"extent_rad_{segment}": float(points[f"extent_{segment}_rad"].median()),
    }


def _weights(
    development: pd.DataFrame, condition: str, seed: int, names: tuple[str, str]
) -> dict[str, float]:
    below, top = names
    own = development[(development["condition"] == condition) & (development["seed"] == seed)]
    last, block = own.sort_values("loop").tail(1), f"rms_{top}_to_{below}"
    values = {f"{block}_before": f"{block}_at_opening", f"{block}_after": block}
    return {
        name: float(last[column].iloc[0]) if column in last and len(last) else np.nan
        for name, column in values.items()
    }


def warnings(numbers: pd.DataFrame, study: Study, followed: Collection[str] = ()) -> list[str]:
    """Return a sentence for the conditions whose maps must not be taken for what was learned.

    In conditions in which the top level is `followed` when initial states are exchanged it has
    learned, however little its weights have moved.
    """
    below, top = level_names(study)
    idle: list[str] = []
    as_drawn: list[str] = []
    for condition in study.conditions:
        own = numbers[numbers["condition"] == condition.name]
        if own.empty:
            continue
        middle = own.drop(columns="condition").median()
        before, after = (middle[f"rms_{top}_to_{below}_{when}"] for when in ("before", "after"))
        if abs(after - before) < UNMOVED * before:
            parts = [1 - middle[f"share_{below}_{segment}"] for segment in SEGMENTS]
            shares = " and ".join(f"{part:.1%}" for part in parts)
            said = f"{condition.name} ({before:.2f} → {after:.2f}; {shares})"
            if max(parts) < NOTHING:
                idle.append(said)
            elif condition.name not in followed:
                as_drawn.append(said)
    sentences, unmoved = [], f"its weights to {below.capitalize()} hardly moved in learning"
    if idle:
        sentences.append(
            f"The slow level does nothing in {listed(idle)}: {unmoved}, and a map over it proves "
            "nothing."
        )
    if as_drawn:
        drawn = "The map shows the slow level as it was drawn at random in"
        sentences.append(f"{drawn} {listed(as_drawn)}: {unmoved}.")
    if sentences:
        sentences[-1] += (
            " (In brackets: the rms of those weights before and after; the share of the variance "
            f"of the first and of the second segment's direction that {top.capitalize()}₀ takes "
            "part in.)"
        )
    return sentences
