"""The scripted caregiver: minimum-jerk strokes, rests, variability, and motionese.

Strokes go the primitive's way between its places, over what the robot's hand can reach: what is
shown can be imitated exactly, as when a caregiver adapts to a child's arm.
"""

from bisect import bisect_right
from collections.abc import Iterable
from itertools import accumulate

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from pydantic import BaseModel, ConfigDict, Field

from motionese.body import SimulatedRobot
from motionese.caregiver.demonstration import Demonstration
from motionese.caregiver.motionese import FURTHEST, Motionese, exaggerated, rounded
from motionese.errors import SettingError
from motionese.minimum_jerk import minimum_jerk
from motionese.task import Primitive, PrimitiveSequence, Task

ASTRAY_CM = 2.0
"""Motionese may lead the hand so far from what the robot's reaches; the nearest way is shown."""


class Manner(BaseModel):
    """The caregiver's way of moving.

    Attributes:
        stroke_steps: Control periods a stroke takes, times the primitive's own duration.
        rest_steps: Control periods of stillness after it.
        variability_mm: Standard deviation [mm] of the hand's deviation from the primitive's way.
        persistence: How much of a deviation is left after one control period (AR(1) coefficient).
        motionese: What is emphasised.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    stroke_steps: int = Field(ge=2, le=1000)
    rest_steps: int = Field(ge=0, le=1000)
    variability_mm: float = Field(ge=0, le=50)
    persistence: float = Field(ge=0, lt=1)
    motionese: Motionese = Motionese()

    @property
    def primitive_rows(self) -> int:
        """Rows of a primitive of duration 1 with its rest, as it is shown to an adult."""
        return self.stroke_steps + self.rest_steps

    def to_adults(self) -> "Manner":
        """Return the manner without motionese."""
        return self.model_copy(update={"motionese": Motionese()})

    def at(self, loop: int, error_cm: float | None) -> "Manner":
        """Return the manner in a loop of development, see `Motionese.at`."""
        return self.model_copy(update={"motionese": self.motionese.at(loop, error_cm)})

    def begins(self, sequence: PrimitiveSequence) -> tuple[int, ...]:
        """Return the rows at which the sequence's primitives begin, and how many rows it has."""
        last = len(sequence.primitives) - 1
        rows = (
            self.stroke_rows(p) + self.rest_rows(i < last)
            for i, p in enumerate(sequence.primitives)
        )
        return tuple(accumulate(rows, initial=0))

    def rest_rows(self, inner: bool) -> int:
        """Return how many control periods the hand rests, between primitives or at the end."""
        return self.rest_steps + inner * self.motionese.pauses.rows

    def rows_until_next(self, sequence: PrimitiveSequence) -> int:
        """Return how many rows after the start of a sequence another primitive would begin."""
        return self.rows(sequence) + self.motionese.pauses.rows

    def rows(self, sequence: PrimitiveSequence) -> int:
        """Return how many rows, one a control period, showing a sequence takes."""
        return self.begins(sequence)[-1]

    def stroke_rows(self, primitive: Primitive) -> int:
        """Return how many control periods a primitive's stroke takes."""
        return max(round(self.stroke_steps * primitive.duration * self.motionese.slower), 2)


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
        return self.body.reachable(self._wished(sequence))

    def leads_astray(self, sequence: PrimitiveSequence) -> float:
        """Return how far [m] the path would lead beyond what the robot's hand reaches."""
        wished = self._wished(sequence)
        return float(np.linalg.norm(self.body.reachable(wished) - wished, axis=1).max())

    def _wished(self, sequence: PrimitiveSequence) -> Float[ndarray, "T 3"]:
        """Return the path without variability, wherever it leads."""
        pieces, last = [self.task.position(sequence.start)[None]], len(sequence.primitives) - 1
        for i, primitive in enumerate(sequence.primitives):
            stroke = self.manner.stroke_rows(primitive)
            done = np.arange(1, stroke + self.manner.rest_rows(i < last) + 1) / stroke
            pieces.append(self._stroke(primitive, np.minimum(done, 1.0)))
        # Row 0 is the start place itself, so the last rest is one row shorter.
        return np.concatenate(pieces)[:-1]

    def _stroke(self, primitive: Primitive, phase: Float[ndarray, " R"]) -> Float[ndarray, "R 3"]:
        """Return where the hand is at shares of a stroke's time."""
        motionese = self.manner.motionese
        ends = np.array([self.task.position(place) for place in (primitive.start, primitive.end)])
        share = minimum_jerk(phase)
        if further := FURTHEST * motionese.exaggeration.strength:
            if self._is_free(primitive.end):
                share = exaggerated(phase, further)
            elif self._is_free(primitive.start):
                share = 1 - exaggerated(1 - phase, further)
        way = primitive.way(share, *ends)
        if roundness := motionese.roundness.strength:
            way = rounded(way, share, ends, self._outwards(ends), roundness)
        return way

    def _is_free(self, place: str) -> bool:
        """Whether a hand can go beyond a place: nothing is pushed there."""
        return all(p.end != place or not p.effect for p in self.task.primitives)

    def _outwards(self, ends: Float[ndarray, "2 3"]) -> Float[ndarray, "3"]:
        """Return the direction away from the middle of the task's places, across a way."""
        places = np.array([place.position for place in self.task.places.values()])
        middle = places.mean(axis=0)
        normal = np.linalg.svd(places - middle)[2][2]
        across = np.cross(normal, ends[1] - ends[0])
        away = across @ (ends.mean(axis=0) - middle) >= 0
        return np.asarray((1 if away else -1) * across / np.linalg.norm(across))

    def _deviation(self, rows: int, rng: np.random.Generator) -> Float[ndarray, "T 3"]:
        keep = self.manner.persistence
        fresh = rng.standard_normal((rows, 3)) * self.manner.variability_mm / 1000
        deviation = fresh.copy()
        for row in range(1, rows):
            deviation[row] = keep * deviation[row - 1] + np.sqrt(1 - keep**2) * fresh[row]
        return deviation


def check_reach(
    task: Task, manner: Manner, body: SimulatedRobot, sequences: Iterable[PrimitiveSequence]
) -> None:
    """Refuse motionese that leads the hand further than the robot's own can follow.

    Raises:
        SettingError: With the sequence that leads furthest, and the largest strength possible.
    """
    shown = tuple(sequences)

    def furthest(motionese: Motionese) -> tuple[float, str]:
        there = manner.model_copy(update={"motionese": motionese})
        caregiver = ScriptedCaregiver(task, there, body)
        return max((100 * caregiver.leads_astray(s), s.name) for s in shown)

    wanted, kept = manner.motionese, Motionese()
    allowed = max(ASTRAY_CM, furthest(kept)[0])
    for name in ("roundness", "exaggeration"):
        each = getattr(wanted, name)
        steps = [
            kept.model_copy(update={name: each.model_copy(update={"strength": share})})
            for share in np.linspace(0, each.strength, 101).tolist()
        ]
        kept = steps[-1]
        astray, sequence = furthest(kept)
        if astray > allowed:
            most = bisect_right(steps, allowed, key=lambda m: furthest(m)[0]) - 1
            raise SettingError(
                f"caregiver.motionese.{name}.strength = {each.strength:g} leads {sequence} "
                f"{astray:.1f} cm beyond what the robot's hand reaches, {allowed:.1f} cm are "
                f"allowed: the largest possible is {getattr(steps[max(most, 0)], name).strength:g}"
            )
