"""The scripted caregiver: minimum-jerk strokes, rests, variability.

Strokes go the primitive's way between its places, over what the robot's hand can reach: what is
shown can be imitated exactly, as when a caregiver adapts to a child's arm.
"""

from itertools import accumulate

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from pydantic import BaseModel, ConfigDict, Field

from motionese.body import SimulatedRobot
from motionese.caregiver.demonstration import Demonstration
from motionese.minimum_jerk import minimum_jerk
from motionese.task import Primitive, PrimitiveSequence, Task


class Manner(BaseModel):
    """The caregiver's way of moving.

    Attributes:
        stroke_steps: Control periods a stroke takes, times the primitive's own duration.
        rest_steps: Control periods of stillness after it.
        variability_mm: Standard deviation [mm] of the hand's deviation from the primitive's way.
        persistence: How much of a deviation is left after one control period (AR(1) coefficient).
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    stroke_steps: int = Field(ge=2, le=1000)
    rest_steps: int = Field(ge=0, le=1000)
    variability_mm: float = Field(ge=0, le=50)
    persistence: float = Field(ge=0, lt=1)

    @property
    def primitive_rows(self) -> int:
        """Rows of a primitive of duration 1 with its rest."""
        return self.stroke_steps + self.rest_steps

    def begins(self, sequence: PrimitiveSequence) -> tuple[int, ...]:
        """Return the rows at which the sequence's primitives begin, and how many rows it has."""
        rows = (self.stroke_rows(p) + self.rest_steps for p in sequence.primitives)
        return tuple(accumulate(rows, initial=0))

    def rows(self, sequence: PrimitiveSequence) -> int:
        """Return how many rows, one a control period, showing a sequence takes."""
        return self.begins(sequence)[-1]

    def stroke_rows(self, primitive: Primitive) -> int:
        """Return how many control periods a primitive's stroke takes."""
        return max(round(self.stroke_steps * primitive.duration), 2)


class ScriptedCaregiver:
    """A caregiver who moves as a `Manner` says."""

    def __init__(self, task: Task, manner: Manner, body: SimulatedRobot) -> None:
        self.task, self.manner, self.body = task, manner, body

    def demonstrate(self, sequence: PrimitiveSequence, rng: np.random.Generator) -> Demonstration:
        """Show a sequence, new in its details with every generator."""
        path = self.intended(sequence)
        path = path + self._deviation(len(path), rng)
        return Demonstration(path, self.manner.begins(sequence)[:-1])

    def intended(self, sequence: PrimitiveSequence) -> Float[ndarray, "T 3"]:
        """Return the path [m, world] without variability."""
        pieces = [self.task.position(sequence.start)[None]]
        for primitive in sequence.primitives:
            stroke = self.manner.stroke_rows(primitive)
            done = np.arange(1, stroke + self.manner.rest_steps + 1) / stroke
            ends = (self.task.position(place) for place in (primitive.start, primitive.end))
            pieces.append(primitive.way(minimum_jerk(np.minimum(done, 1.0)), *ends))
        # Row 0 is the start place itself, so the last rest is one row shorter.
        return self.body.reachable(np.concatenate(pieces)[:-1])

    def _deviation(self, rows: int, rng: np.random.Generator) -> Float[ndarray, "T 3"]:
        keep = self.manner.persistence
        fresh = rng.standard_normal((rows, 3)) * self.manner.variability_mm / 1000
        deviation = fresh.copy()
        for row in range(1, rows):
            deviation[row] = keep * deviation[row - 1] + np.sqrt(1 - keep**2) * fresh[row]
        return deviation
