"""A lesson: practices one after the other, and the network that is kept of them.

A practice may lead away again from the motion that is practised, or from others. So the network is
kept that does best at the motion taught, what is to be pushed first, among those that, over all
that the robot was taught, miss by no more than before; where there is none, the robot stays as it
was.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from motionese.teaching.claim import Claim
from motionese.teaching.notebook import Change
from motionese.teaching.result import Result

AS_BEFORE = "I kept what I knew before"
TOLD_CM = 0.05
"""Smaller changes are not told."""


@dataclass(frozen=True)
class Lesson:
    """What a lesson has brought.

    Attributes:
        entry: The notebook's entry that was practised.
        errors_cm: The error of every try [cm]; the first is that before.
        kept: After how many practices the network is kept; 0 as it was before.
        changes: The motion taught, and all others that the robot was taught, before and after.
        result: What a try comes to now.
        claim: What the robot claims of the motion now.
        missed: Of every try how many pushes failed that were due.
    """

    entry: int
    errors_cm: tuple[float, ...]
    kept: int
    changes: tuple[Change, ...]
    result: Result
    claim: Claim
    missed: tuple[int, ...]

    @property
    def sentence(self) -> str:
        """What the lesson has brought, in words."""
        taught, pressed = self.changes[0], self.result.pressed
        outcome = f", and it {pressed}" if pressed else ""
        if self.kept:
            return f"{taught.before_cm:.1f} → {taught.after_cm:.1f} cm{outcome}."
        tries = [*zip(self.errors_cm, self.missed, strict=True)]
        better = any(cm < tries[0][0] and missed <= tries[0][1] for cm, missed in tries)
        why = "practising this made others worse" if better else "practice did not make it better"
        return f"{AS_BEFORE}: {why}. It misses by {taught.after_cm:.1f} cm{outcome}."


def kept_practice(
    errors_cm: Sequence[float], overall_cm: Callable[[int], float], missed: Sequence[int]
) -> int:
    """Return after how many practices the network is kept.

    Args:
        errors_cm: The error at the motion taught before, and after every practice.
        overall_cm: Returns the mean error over all that was taught, after so many practices.
        missed: How many pushes failed that were due, likewise; a push counts more than nearness.
    """
    before = overall_cm(0)
    no_worse = (
        n
        for n in range(1, len(errors_cm))
        if errors_cm[n] <= errors_cm[0] and missed[n] <= missed[0]
    )
    best_first = sorted(no_worse, key=lambda n: (missed[n], errors_cm[n]))
    return next((n for n in best_first if overall_cm(n) <= before), 0)


def growth_in_words(changes: Sequence[Change]) -> str:
    """Return what opening a level has brought to all that the robot was taught."""
    worse = [c.motion for c in changes if c.after_cm > c.before_cm + TOLD_CM]
    if not worse:
        return "A slow level is open, and nothing got worse."
    them = "it" if len(worse) == 1 else "them"
    return (
        f"{len(worse)} of {len(changes)} got worse ({', '.join(worse)}); practise {them} again. "
        "The slow level stays open, since you asked for it."
    )
