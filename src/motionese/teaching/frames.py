"""A performance as a film of poses and activity, for a page that shows it in real time."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import Geometry
from motionese.caregiver import lasting
from motionese.imitation import Performance

FRAMES_A_ROW = 2
"""Frames a control period: 20 a second at a body's 10 Hz."""
DIGITS = 4


@dataclass(frozen=True)
class Film:
    """A performance, frame by frame.

    Attributes:
        rate_hz: Frames a second.
        columns: By name an array whose first axis is the frame: `poses` (7 numbers a body, see
            `Geometry.placed`), `commanded` and `actual` joint angles [rad], `effects` (what the
            task's things told, in the task's order).
        activity: The units' output y by level, in the same way.
    """

    rate_hz: float
    columns: dict[str, Float[ndarray, "F _"]]
    activity: dict[str, Float[ndarray, "F _"]]

    def __len__(self) -> int:
        return len(self.columns["poses"])

    def part(self, begin: int, end: int) -> dict[str, Any]:
        """Return some frames as lists of rounded numbers, for JSON."""
        columns, activity = (
            {name: np.round(each[begin:end], DIGITS).tolist() for name, each in arrays.items()}
            for arrays in (self.columns, self.activity)
        )
        return {**columns, "activity": activity}


def film(
    geometry: Geometry, levels: Mapping[str, int], performance: Performance, rate_hz: float
) -> Film:
    """Return the film of a performance of so many rows a second, outside and inside.

    `levels` are the sizes of the network's levels by name.
    """
    rows = len(performance.path)
    frames = FRAMES_A_ROW * (rows - 1) + 1
    columns = {
        "commanded": performance.commanded,
        "actual": performance.sensed[:, performance.joints],
        "effects": np.array([*performance.effects.values()]).reshape(-1, rows).T,
    }
    finer = {name: lasting(column, frames) for name, column in columns.items() if column.size}
    poses = geometry.placed(lasting(performance.poses, frames))
    inside = np.split(performance.activity, np.cumsum([*levels.values()])[:-1], axis=1)
    return Film(
        rate_hz=FRAMES_A_ROW * rate_hz,
        columns={"poses": poses.reshape(frames, -1), "effects": np.zeros((frames, 0)), **finer},
        activity={name: lasting(units, frames) for name, units in zip(levels, inside, strict=True)},
    )
