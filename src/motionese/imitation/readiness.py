"""When a learner is ready for what comes next: by its errors, or by what has emerged inside it."""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import inf

import numpy as np
from pydantic import Field, model_validator

from motionese.imitation.settings import Group


@dataclass(frozen=True)
class LoopDone:
    """What a loop tells of the course of a development.

    Attributes:
        stage: The stage it belongs to, from 0.
        errors: Imitation error [cm] of every motion that was shown, by its name.
        levels: How many levels of the network were open.
        emerged: By level how much of what it is for has emerged, see `share_emerged`.
    """

    stage: int
    errors: Mapping[str, float]
    levels: int
    emerged: Mapping[str, float] = field(default_factory=dict)

    @property
    def error_cm(self) -> float:
        """The mean error [cm] over what was shown."""
        return float(np.mean(list(self.errors.values())))


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


class Mastered(Group):
    """When a motion is mastered: it was below an imitation error [cm] the last times, so many."""

    loops: int = Field(default=2, ge=1)
    below_cm: float = Field(default=2.0, gt=0, allow_inf_nan=False)

    def by(self, errors_cm: Sequence[float]) -> bool:
        """Whether a motion is mastered by its errors, one each time that it was shown."""
        last = errors_cm[-self.loops :]
        return len(last) == self.loops and max(last) < self.below_cm


class Emerged(Group):
    """When what a level is for has emerged: in the last loops, so many, by this share or more."""

    level: str
    loops: int = Field(default=2, ge=1)
    share: float = Field(default=0.9, gt=0, le=1)

    def by(self, shares: Sequence[float]) -> bool:
        """Whether it has emerged by these shares, one a loop."""
        last = shares[-self.loops :]
        return len(last) == self.loops and min(last) >= self.share


class Until(Group):
    """How long something lasts: so many loops at most, or until the learner is ready.

    Whichever comes first ends it. What tells that the learner is ready is asked of the loops since
    the last change of lesson or network.

    Attributes:
        loops: Its own loops.
        in_all: Loops of the whole development.
        least: Own loops before readiness counts.
        settled: Learning has settled.
        mastered: Every motion of the lesson is mastered.
        emerged: What a level is for has emerged.
    """

    loops: int | None = Field(default=None, ge=1)
    in_all: int | None = Field(default=None, ge=1)
    least: int = Field(default=1, ge=1)
    settled: Settled | None = None
    mastered: Mastered | None = None
    emerged: Emerged | None = None

    @model_validator(mode="after")
    def _can_be_met(self) -> "Until":
        if self.loops is None and self.in_all is None:
            raise ValueError("it needs an end that is sure to come, loops or in_all")
        most = self.ends(0)
        if self.least > most:
            raise ValueError(f"least = {self.least} loops are more than it lasts at most, {most}")
        for name, asked in self._criteria():
            if asked.loops > most:
                raise ValueError(
                    f"{name}.loops = {asked.loops} can never be met, it lasts {most} loops at most"
                )
        return self

    def ends(self, begun: int) -> int:
        """Return after which loop it ends at the latest if it began after so many."""
        own = inf if self.loops is None else begun + self.loops
        return max(int(min(own, inf if self.in_all is None else self.in_all)), begun + 1)

    def over(
        self, begun: int, done: int, steady: Sequence[LoopDone], lesson: Collection[str]
    ) -> bool:
        """Whether it is over.

        Args:
            begun: How many loops were done when it began.
            done: How many are done now.
            steady: Those of them since the last change of lesson or network.
            lesson: The names of what is taught.
        """
        if done >= self.ends(begun):
            return True
        return done - begun >= self.least and self._ready(steady, lesson)

    def _ready(self, steady: Sequence[LoopDone], lesson: Collection[str]) -> bool:
        if self.settled is not None and self.settled.by(lesson_errors(steady, lesson)):
            return True
        if self.mastered is not None:
            by_motion = errors_by_motion(steady, lesson)
            if all(self.mastered.by(errors) for errors in by_motion.values()):
                return True
        asked = self.emerged
        return asked is not None and asked.by([d.emerged.get(asked.level, 0.0) for d in steady])

    def _criteria(self) -> Iterator[tuple[str, Settled | Mastered | Emerged]]:
        for name in ("settled", "mastered", "emerged"):
            if (asked := getattr(self, name)) is not None:
                yield name, asked


def errors_by_motion(loops: Sequence[LoopDone], lesson: Collection[str]) -> dict[str, list[float]]:
    """Return the errors [cm] of every motion of a lesson, one each time that it was shown."""
    return {m: [loop.errors[m] for loop in loops if m in loop.errors] for m in lesson}


def lesson_errors(loops: Sequence[LoopDone], lesson: Collection[str]) -> list[float]:
    """Return the mean error [cm] over a lesson after every loop.

    A motion that was not shown in a loop counts by its error before; infinite until all were shown.
    """
    latest, means = dict.fromkeys(lesson, inf), []
    for loop in loops:
        latest |= {motion: error for motion, error in loop.errors.items() if motion in latest}
        means.append(float(np.mean(list(latest.values()))))
    return means
