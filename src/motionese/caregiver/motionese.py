"""Motionese: how a caregiver emphasises what is shown to a child, and how that fades.

What is modified, each by a strength from 0, as to an adult, to 1:

- *pauses*: between two primitives the hand rests longer, at 1 by `steps` control periods. A pause
  belongs to the primitive before it, as every rest does.
- *exaggeration*: a stroke leads further than it need, at 1 by `FURTHEST` of its way, and bends back
  to its true end. Beyond an end where something is pushed the hand cannot go: such a stroke swings
  further back at its beginning instead.
- *slowness*: a stroke takes longer, at 1 twice as long.
- *roundness*: from −1, where ways are straight, to 1, where they bow outwards by `BOW` of the
  distance that they lead.
- *repetition*: a motion is shown again, at 1 `MOST_SHOWN` times; the robot goes by the mean of what
  it has seen.

R. J. Brand, D. A. Baldwin and L. A. Ashburn, Developmental Science 5 (2002); Y. Nagai and
K. J. Rohlfing, IEEE Transactions on Autonomous Mental Development 1 (2009). `motionese.kinematics`
measures it.
"""

from typing import Literal

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from pydantic import BaseModel, ConfigDict, Field, field_validator

from motionese.minimum_jerk import minimum_jerk

FURTHEST = 0.25
"""At full strength a stroke leads so much further, as a share of its way."""
BOW = 0.25
"""At full strength a way bows outwards by so much of the distance that it leads."""
MOST_SHOWN = 4
"""At full strength a motion is shown so many times."""

Course = Literal["constant", "loops", "error"]
"""How a strength fades: not; over the loops of development; with the learner's imitation error."""


class Emphasis(BaseModel):
    """One thing that a caregiver emphasises, and how that fades."""

    model_config = ConfigDict(frozen=True, extra="forbid")

    strength: float = Field(default=0.0, ge=0, le=1)
    course: Course = "constant"


class Pauses(Emphasis):
    """Longer rests between primitives: by `steps` control periods at full strength."""

    steps: int = Field(default=8, ge=1, le=100)

    @property
    def rows(self) -> int:
        """How many control periods a rest between two primitives is longer."""
        return round(self.strength * self.steps)


class Roundness(Emphasis):
    """Rounder ways, or straighter ones below 0."""

    strength: float = Field(default=0.0, ge=-1, le=1)


class Motionese(BaseModel):
    """All that a caregiver emphasises.

    Attributes:
        fading_loops: What fades over loops is at its full strength up to the first of them, and
            gone in the last.
        fading_cm: What fades with the error is gone below the first imitation error [cm], and at
            its full strength from the second on.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    pauses: Pauses = Pauses()
    exaggeration: Emphasis = Emphasis()
    slowness: Emphasis = Emphasis()
    roundness: Roundness = Roundness()
    repetition: Emphasis = Emphasis()
    fading_loops: tuple[int, int] = (16, 30)
    fading_cm: tuple[float, float] = (2.0, 6.0)

    @field_validator("fading_loops", "fading_cm")
    @classmethod
    def _rises(cls, course: tuple[float, float]) -> tuple[float, float]:
        if not (0 <= course[0] < course[1] < np.inf):
            raise ValueError(
                f"a course must lead from one number ≥ 0 to a larger one, got {list(course)}"
            )
        return course

    def at(self, loop: int, error_cm: float | None) -> "Motionese":
        """Return what is left of it, as a constant, in a loop of development.

        Args:
            loop: The loop's number, from 1.
            error_cm: The learner's mean imitation error [cm] in the loop before; None where a
                lesson has just begun: all that fades with the error is at its full strength.
        """
        first, last = self.fading_loops
        none, full = self.fading_cm
        left = {
            "constant": 1.0,
            "loops": (last - loop) / (last - first),
            "error": 1.0 if error_cm is None else (error_cm - none) / (full - none),
        }
        faded = {}
        for name, each in self:
            if isinstance(each, Emphasis):
                strength = each.strength * min(max(left[each.course], 0.0), 1.0)
                faded[name] = each.model_copy(update={"strength": strength, "course": "constant"})
        return self.model_copy(update=faded)

    @property
    def slower(self) -> float:
        """How many times as long a stroke takes."""
        return 1.0 + self.slowness.strength

    @property
    def times_shown(self) -> int:
        """How many times a motion is shown."""
        return 1 + round(self.repetition.strength * (MOST_SHOWN - 1))

    @property
    def emphasises(self) -> bool:
        """Whether anything is emphasised."""
        return any(each.strength for _, each in self if isinstance(each, Emphasis))

    @property
    def leaves_the_way(self) -> bool:
        """Whether the hand goes where it would not go for an adult."""
        return bool(self.exaggeration.strength or self.roundness.strength)


FULL = Motionese(
    pauses=Pauses(strength=1),
    exaggeration=Emphasis(strength=1),
    slowness=Emphasis(strength=1),
    roundness=Roundness(strength=1),
    repetition=Emphasis(strength=1),
)
"""Everything emphasised at full strength."""


def exaggerated(phase: Float[ndarray, " R"], further: float) -> Float[ndarray, " R"]:
    """Return the share of its way that a stroke has done, which leads further and bends back.

    There and back it is a movement of minimum jerk each, that take time as they lead far.

    Args:
        phase: Share of the stroke's time, 0 to 1.
        further: By how much of its way it leads beyond the end, above 0.
    """
    turn = (1 + further) / (1 + 2 * further)
    there = minimum_jerk(np.minimum(phase / turn, 1.0))
    back = minimum_jerk(np.maximum(phase - turn, 0.0) / (1 - turn))
    return np.asarray((1 + further) * there - further * back)


def rounded(
    way: Float[ndarray, "R 3"],
    share: Float[ndarray, " R"],
    ends: Float[ndarray, "2 3"],
    outwards: Float[ndarray, "3"],
    roundness: float,
) -> Float[ndarray, "R 3"]:
    """Return a way that is rounder, or straighter where `roundness` is below 0.

    Args:
        way: Points [m].
        share: The share of the way at which each lies; beyond 0 to 1 nothing bows.
        ends: Where the way begins and ends [m].
        outwards: The direction in which it bows, of length 1.
        roundness: From −1 to 1.
    """
    leads = ends[1] - ends[0]
    if roundness < 0:
        straight = ends[0] + share[:, None] * leads
        return np.asarray(way + roundness * (way - straight))
    bow = np.sin(np.pi * np.clip(share, 0.0, 1.0))[:, None] * outwards
    return np.asarray(way + roundness * BOW * np.linalg.norm(leads) * bow)
