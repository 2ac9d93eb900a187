"""How the caregiver's hand moves when it shows a motion: minimum-jerk strokes, rests, variability.

Strokes run straight between corners, over the surface that the robot's hand can reach: what is
shown can be imitated exactly, as when a caregiver adapts to a child's arm.
"""

from collections.abc import Mapping
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from pydantic import BaseModel, ConfigDict, Field

from motionese.body import CORNERS, arm_reaching, projected
from motionese.caregiver.task import Motion
from motionese.errors import TaskError, unknown
from motionese.minimum_jerk import minimum_jerk


class Demonstrating(BaseModel):
    """The caregiver's way of moving.

    Attributes:
        stroke_steps: Control periods a stroke takes.
        rest_steps: Control periods of stillness after it.
        variability_mm: Standard deviation [mm] of the hand's deviation from the straight stroke.
        persistence: How much of a deviation is left after one control period (AR(1) coefficient).
        corners: Positions [m] of corners that differ from the standard ones.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    stroke_steps: int = Field(ge=2, le=1000)
    rest_steps: int = Field(ge=0, le=1000)
    variability_mm: float = Field(ge=0, le=50)
    persistence: float = Field(ge=0, lt=1)
    corners: dict[str, tuple[float, float, float]] = {}

    def corner(self, name: str) -> Float[ndarray, "3"]:
        """Return where the hand is at a corner [m, world]."""
        return np.array(self.corners.get(name, CORNERS[name]))

    def rows(self, motion: Motion) -> int:
        """Return how many rows, one a control period, showing a motion takes."""
        return len(motion.primitives) * (self.stroke_steps + self.rest_steps)


@runtime_checkable
class Caregiver(Protocol):
    """Whoever shows motions: the scripted caregiver, or recorded demonstrations."""

    def demonstrate(self, motion: Motion, rng: np.random.Generator) -> Float[ndarray, "T 3"]:
        """Return the hand's path [m, world], one row a control period."""
        ...


class ScriptedCaregiver:
    """A caregiver who moves as `Demonstrating` says."""

    def __init__(self, manner: Demonstrating) -> None:
        """Check that the robot can reach every corner.

        Raises:
            TaskError: A corner that does not exist, or that the robot's hand does not reach.
        """
        for name in manner.corners:
            if name not in CORNERS:
                raise TaskError(unknown("corner", name, CORNERS))
        for name in CORNERS:
            arm_reaching(manner.corner(name), name=f"corner {name}")
        self.manner = manner

    def demonstrate(self, motion: Motion, rng: np.random.Generator) -> Float[ndarray, "T 3"]:
        """Return the hand's path, new in its details with every generator."""
        path = self.intended(motion)
        shown: Float[ndarray, "T 3"] = path + self._deviation(len(path), rng)
        return shown

    def intended(self, motion: Motion) -> Float[ndarray, "T 3"]:
        """Return the path without variability."""
        corners = np.array([self.manner.corner(name) for name in motion.corners])
        stroke, rest = self.manner.stroke_steps, self.manner.rest_steps
        share = minimum_jerk(np.minimum(np.arange(1, stroke + rest + 1) / stroke, 1.0))
        strokes = [a + share[:, None] * (b - a) for a, b in pairwise(corners)]
        # Row 0 is the start corner itself, so the last rest is one row shorter.
        return projected(np.concatenate([corners[:1], *strokes])[:-1])

    def _deviation(self, rows: int, rng: np.random.Generator) -> Float[ndarray, "T 3"]:
        keep = self.manner.persistence
        fresh = rng.standard_normal((rows, 3)) * self.manner.variability_mm / 1000
        deviation = fresh.copy()
        for row in range(1, rows):
            deviation[row] = keep * deviation[row - 1] + np.sqrt(1 - keep**2) * fresh[row]
        return deviation


class RecordedCaregiver:
    """Recorded demonstrations in the place of the scripted caregiver."""

    def __init__(
        self,
        recordings: Mapping[str, list[Float[ndarray, "_ 3"]]],
        otherwise: Caregiver | None = None,
    ) -> None:
        """Take recorded paths [m, world] by motion name, at the body's rate.

        Args:
            recordings: The paths.
            otherwise: Who shows what was not recorded.
        """
        self.recordings, self.otherwise = dict(recordings), otherwise

    def demonstrate(self, motion: Motion, rng: np.random.Generator) -> Float[ndarray, "T 3"]:
        """Return one of the motion's recordings; `TaskError` if nobody can show it."""
        paths = self.recordings.get(motion.name)
        if not paths and self.otherwise is not None:
            return self.otherwise.demonstrate(motion, rng)
        if not paths:
            raise TaskError(unknown("recorded motion", motion.name, self.recordings))
        return np.asarray(paths[int(rng.integers(len(paths)))])
