"""Development: what is taught in which stage, which levels are open, and when either changes.

What comes next follows from the loops so far, and from nothing else: a run that was stopped goes on
from what it has written, to the same bits, also where a change waits until the learner is ready.
Lesson and network change by clocks of their own: a stage ends, and a further level opens, after so
many loops or when the learner is ready for it.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import takewhile

from motionese.caregiver import Manner
from motionese.imitation.choosing import Choosing
from motionese.imitation.readiness import LoopDone, Until
from motionese.task import PrimitiveSequence


@dataclass(frozen=True)
class Stage:
    """One stage of a development.

    Attributes:
        lesson: The sequences that are taught.
        levels: How many levels of the network are open at least.
        manner: How the caregiver moves.
        until: When it ends.
        choosing: What of the lesson is shown in a loop.
    """

    lesson: tuple[PrimitiveSequence, ...]
    levels: int
    manner: Manner
    until: Until
    choosing: Choosing = field(default_factory=Choosing)

    def at(self, loop: int, error_cm: float | None) -> "Stage":
        """Return the stage as the caregiver shows its lesson in a loop, see `Motionese.at`."""
        return replace(self, manner=self.manner.at(loop, error_cm))


@dataclass(frozen=True)
class Development:
    """Stages that follow each other, and when the network grows beside them.

    Attributes:
        stages: The stages.
        openings: By how many levels are open: until when that stays so.
    """

    stages: tuple[Stage, ...]
    openings: Mapping[int, Until] = field(default_factory=dict)

    def next_stage(self, done: Sequence[LoopDone]) -> int | None:
        """Return which stage (from 0) the next loop belongs to; None if development has ended."""
        if not done:
            return 0
        now = done[-1].stage
        begun = sum(loop.stage < now for loop in done)
        over = self.stages[now].until.over(begun, len(done), _steady(done), self._lesson(now))
        return now + over if now + over < len(self.stages) else None

    def next_levels(self, stage: int, done: Sequence[LoopDone]) -> int:
        """Return how many levels are open in the next loop, which belongs to a stage (from 0)."""
        if not done:
            return self.stages[stage].levels
        now = done[-1].levels
        begun, opening = sum(loop.levels < now for loop in done), self.openings.get(now)
        lesson = self._lesson(done[-1].stage)
        opens = opening is not None and opening.over(begun, len(done), _steady(done), lesson)
        return max(self.stages[stage].levels, now + opens)

    def most_loops(self) -> int:
        """Return how many loops it has at most."""
        loops = 0
        for stage in self.stages:
            loops = stage.until.ends(loops)
        return loops

    def _lesson(self, stage: int) -> Collection[str]:
        return [sequence.name for sequence in self.stages[stage].lesson]


def _steady(done: Sequence[LoopDone]) -> list[LoopDone]:
    """Return the loops since the last change of lesson or network."""
    last = done[-1].stage, done[-1].levels
    since = takewhile(lambda loop: (loop.stage, loop.levels) == last, reversed(done))
    return list(since)[::-1]
