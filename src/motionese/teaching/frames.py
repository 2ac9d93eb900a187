"""A performance as a film of poses and activity, for a page that shows it in real time."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import Geometry
from motionese.experiment import Scene
from motionese.experiment.perform import ARM, Performance
from motionese.learning import activity
from motionese.network import MTRNN
from motionese.teaching.drawing import lasting

FRAMES_A_ROW = 2
"""Frames a control period: 20 a second at the body's 10 Hz."""
DIGITS = 4


@dataclass(frozen=True)
class Film:
    """A performance, frame by frame.

    Attributes:
        rate_hz: Frames a second.
        columns: By name an array whose first axis is the frame: `poses` (7 numbers a body, see
            `Geometry.placed`), `commanded` and `actual` arm angles [rad], `io`, `cf`, `cs`
            (activity y), `buttons` (right, left [mm]).
    """

    rate_hz: float
    columns: dict[str, Float[ndarray, "F _"]]

    def __len__(self) -> int:
        return len(self.columns["poses"])

    def part(self, begin: int, end: int) -> dict[str, Any]:
        """Return some frames as lists of rounded numbers, for JSON."""
        return {
            name: np.round(column[begin:end], DIGITS).tolist()
            for name, column in self.columns.items()
        }


def film(
    scene: Scene,
    geometry: Geometry,
    network: MTRNN,
    state: Float[ndarray, " N"],
    performance: Performance,
    steps: int,
) -> Film:
    """Return the film of a performance.

    Args:
        scene: Where it was performed.
        geometry: The robot's shapes.
        network: The network that performed.
        state: The initial state it performed from.
        performance: What was recorded.
        steps: At least its rows; always the same, so that nothing is compiled twice.
    """
    rows = len(performance.path)
    first = performance.experience(scene.settings.imitation.efference_copy)[0]
    inside = activity(network, state, steps, first=first)[:rows]
    frames = FRAMES_A_ROW * (rows - 1) + 1
    columns = {
        "poses": performance.poses,
        "commanded": performance.commanded,
        "actual": performance.sensed[:, ARM],
        "buttons": performance.depths,
        **{level.name: inside[:, network.units(level.name)] for level in network.levels},
    }
    finer = {name: lasting(column, frames) for name, column in columns.items()}
    finer["poses"] = geometry.placed(finer["poses"]).reshape(frames, -1)
    finer.setdefault("cs", np.zeros((frames, 0)))
    return Film(FRAMES_A_ROW * scene.body.rate_hz, finer)
