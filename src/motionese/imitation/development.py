"""Development in stages: what is taught, which levels are open, and when a stage ends.

Which stage comes next follows from the loops so far, and from nothing else: a run that was stopped
goes on from what it has written, to the same bits, also where a stage ends when learning has
settled.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from pydantic import Field

from motionese.caregiver import Manner
from motionese.imitation.settings import Group
from motionese.task import PrimitiveSequence


class Settled(Group):
    """When learning has settled: the last errors are small, or hardly smaller than those before.

    Attributes:
        loops: So many last loops are looked at, and compared with so many before them.
        below_cm: All of the last ones are below this imitation error [cm], or …
        share: … their mean is larger than this share of the mean of those before.
    """

    loops: int = Field(default=3, ge=1)
    below_cm: float = Field(default=2.0, ge=0)
    share: float = Field(default=0.8, gt=0, le=1)

    def by(self, errors_cm: Sequence[float]) -> bool:
        """Whether learning has settled by these errors, one a loop."""
        last, before = errors_cm[-self.loops :], errors_cm[-2 * self.loops : -self.loops]
        if len(last) < self.loops:
            return False
        if max(last) < self.below_cm:
            return True
        return len(before) == self.loops and bool(np.mean(last) > self.share * np.mean(before))


class Until(Group):
    """When a stage ends: after so many loops, or earlier when learning has settled."""

    loops: int = Field(ge=1)
    settled: Settled | None = None

    def over(self, errors_cm: Sequence[float]) -> bool:
        """Whether the stage is over after loops of these imitation errors [cm]."""
        settled = self.settled is not None and self.settled.by(errors_cm)
        return settled or len(errors_cm) >= self.loops


@dataclass(frozen=True)
class Stage:
    """One stage of a development.

    Attributes:
        lesson: The sequences that are taught.
        levels: How many levels of the network are open.
        manner: How the caregiver moves.
        until: When it ends.
    """

    lesson: tuple[PrimitiveSequence, ...]
    levels: int
    manner: Manner
    until: Until

    def at(self, loop: int, error_cm: float | None) -> "Stage":
        """Return the stage as the caregiver shows its lesson in a loop, see `Motionese.at`."""
        return replace(self, manner=self.manner.at(loop, error_cm))


@dataclass(frozen=True)
class LoopDone:
    """What a loop tells of the course of a development: its stage (from 0), its mean error [cm]."""

    stage: int
    error_cm: float


def next_stage(stages: Sequence[Stage], done: Sequence[LoopDone]) -> int | None:
    """Return which stage (from 0) the next loop belongs to; None if development has ended."""
    if not done:
        return 0
    now = done[-1].stage
    errors = [loop.error_cm for loop in done if loop.stage == now]
    following = now + stages[now].until.over(errors)
    return following if following < len(stages) else None
