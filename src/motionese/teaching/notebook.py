"""The notebook: everything shown so far, how well it was imitated, and what was learned of it."""

from dataclasses import dataclass, replace
from typing import Literal, TypeVar

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import Demonstration
from motionese.teaching.trial import Trial

Source = Literal["drawn", "webcam", "scripted"]


@dataclass(frozen=True)
class Entry:
    """One demonstration.

    Attributes:
        number: Counted from 1; never given twice.
        motion: What it is called: the sequence of the task that was drawn, or any other name.
        source: Who showed it.
        drawn: The hand's path [m, world] as it was drawn in time. [R, 3]
        demonstration: The same at the robot's tempo.
        errors_cm: The imitations' errors, in order [cm].
        tried: The last imitation, whatever the network was then; None before the first.
    """

    number: int
    motion: str
    source: Source
    drawn: Float[ndarray, "R 3"]
    demonstration: Demonstration
    errors_cm: tuple[float, ...] = ()
    tried: Trial | None = None

    def with_trial(self, trial: Trial) -> "Entry":
        """Return the entry with a further imitation."""
        return replace(self, errors_cm=(*self.errors_cm, trial.error_cm), tried=trial)


@dataclass(frozen=True)
class Change:
    """Errors [cm] of an imitation before and after the network changed."""

    motion: str
    before_cm: float
    after_cm: float


Named = TypeVar("Named", Entry, Change)


@dataclass(frozen=True)
class Learning:
    """One learning, or one growth of the network.

    Attributes:
        entry: The notebook's entry that was learned; 0 for growth.
        loop: The last loop that its experience carries.
        before: The number of the learner that was there before.
        kept: After how many practices the network was kept; 0 as it was before.
        changes: All that the robot was taught, before and after; what was practised comes first.
    """

    entry: int
    loop: int
    before: int
    kept: int
    changes: tuple[Change, ...]


@dataclass(frozen=True)
class Point:
    """A motion's error [cm] after so many learnings, and whether it was what was practised."""

    after: int
    error_cm: float
    practised: bool


@dataclass(frozen=True)
class Notebook:
    """Entries and learnings, the oldest first.

    Attributes:
        next: Numbers the next entry.
        ended: The chapters that have ended (see `teaching.chapters`), whatever was undone since.
        renamed: Motions' names before and after, in the order in which they were given.
    """

    entries: tuple[Entry, ...] = ()
    learned: tuple[Learning, ...] = ()
    next: int = 1
    ended: frozenset[str] = frozenset()
    renamed: tuple[tuple[str, str], ...] = ()

    def entry(self, number: int) -> Entry | None:
        """Return the entry of a number, or None if there is none (any more)."""
        return next((e for e in self.entries if e.number == number), None)

    def entry_like(self, other: Entry) -> Entry | None:
        """Return the latest entry that shows the same as one of another notebook, or None."""
        path = other.demonstration.path
        same = (e for e in reversed(self.entries) if np.array_equal(e.demonstration.path, path))
        return next(same, None)

    def with_entry(self, entry: Entry) -> "Notebook":
        """Return the notebook with a new or changed entry."""
        entries = {e.number: e for e in (*self.entries, entry)}
        following = max(self.next, entry.number + 1)
        return replace(self, entries=tuple(entries.values()), next=following)

    def without(self, number: int) -> "Notebook":
        """Return the notebook without an entry, and without what was learned of it."""
        return replace(
            self,
            entries=tuple(e for e in self.entries if e.number != number),
            learned=tuple(each for each in self.learned if each.entry != number),
        )

    def with_name(self, motion: str, name: str) -> "Notebook":
        """Return the notebook with a motion called by another name."""

        def named(each: Named) -> Named:
            return replace(each, motion=name) if each.motion == motion else each

        learned = (replace(e, changes=tuple(map(named, e.changes))) for e in self.learned)
        return replace(
            self,
            entries=tuple(map(named, self.entries)),
            learned=tuple(learned),
            renamed=(*self.renamed, (motion, name)),
        )

    def called_now(self, motion: str) -> str:
        """Return what a motion is called that had this name once."""
        for before, name in self.renamed:
            motion = name if motion == before else motion
        return motion

    def taught(self) -> dict[str, Demonstration]:
        """Return the latest demonstration of every motion that was practised."""
        practised = {each.entry for each in self.learned}
        return {e.motion: e.demonstration for e in self.entries if e.number in practised}

    @property
    def curves(self) -> dict[str, list[Point]]:
        """Return by motion its error before its first learning, and after every one since."""
        curves: dict[str, list[Point]] = {}
        for number, learning in enumerate(self.learned, 1):
            for place, change in enumerate(learning.changes):
                practised = bool(learning.entry) and place == 0
                curve = curves.setdefault(
                    change.motion, [Point(number - 1, change.before_cm, practised=False)]
                )
                curve.append(Point(number, change.after_cm, practised))
        return curves

    @property
    def last_loop(self) -> int:
        """The latest loop of a learning; 0 before the first."""
        return max((each.loop for each in self.learned), default=0)
