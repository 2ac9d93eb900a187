"""What of a lesson the caregiver shows next: all of it, or what the learner's errors suggest.

Scaffolding goes from the easiest motion that is not yet mastered on; by learning progress (as in
Oudeyer, Kaplan & Hafner 2007) what is shown is that which changes most, neither what is known nor
what is out of reach; a random choice is the control of both. Of a motion that was never shown, or
once for progress, nothing is known: it is shown first.
"""

from collections.abc import Sequence
from math import inf
from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from motionese.imitation.readiness import LoopDone, Mastered, errors_by_motion
from motionese.imitation.settings import Group
from motionese.task import PrimitiveSequence


class Choosing(Group):
    """How the caregiver chooses.

    Attributes:
        by: What is chosen: the "whole" lesson; the "easiest", those not yet mastered with the
            smallest last error; "progress", those whose last two errors differ most; "random".
        shown: How many motions are shown in a loop; all where the whole lesson is.
        mastered: When a motion is; those shown longest ago come back where nothing else is left.
    """

    by: Literal["whole", "easiest", "progress", "random"] = "whole"
    shown: int | None = Field(default=None, ge=1)
    mastered: Mastered = Mastered()

    @model_validator(mode="after")
    def _shows_a_part(self) -> "Choosing":
        if (self.by == "whole") != (self.shown is None):
            raise ValueError(
                "shown says how many motions are chosen: it is needed for all but the whole lesson"
            )
        return self

    def chosen(
        self,
        lesson: tuple[PrimitiveSequence, ...],
        done: Sequence[LoopDone],
        rng: np.random.Generator,
    ) -> tuple[PrimitiveSequence, ...]:
        """Return what is shown next, in the lesson's order.

        Args:
            lesson: What may be shown.
            done: The loops so far.
            rng: What a random choice is drawn from.
        """
        if self.shown is None:
            return lesson
        by_motion = errors_by_motion(done, [s.name for s in lesson])
        ranks: dict[str, tuple[float, ...]]
        if self.by == "random":
            ranks = {
                m: (float(r),) for m, r in zip(by_motion, rng.permutation(len(lesson)), strict=True)
            }
        else:
            ranks = {m: self._rank(m, errors, done) for m, errors in by_motion.items()}
        first = sorted(lesson, key=lambda s: ranks[s.name])[: self.shown]
        return tuple(s for s in lesson if s in first)

    def _rank(
        self, motion: str, errors: Sequence[float], done: Sequence[LoopDone]
    ) -> tuple[float, ...]:
        if self.by == "progress":
            known = min(len(errors), 2)
            return known, -abs(errors[-1] - errors[-2]) if known == 2 else 0.0
        if not self.mastered.by(errors):
            return (0.0, errors[-1] if errors else -inf)
        return (1.0, max(i for i, loop in enumerate(done) if motion in loop.errors))
