"""The notebook: everything shown so far, how well it was imitated, and what was learned of it."""

from dataclasses import dataclass, replace
from typing import Literal

from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import Demonstration

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
    """

    number: int
    motion: str
    source: Source
    drawn: Float[ndarray, "R 3"]
    demonstration: Demonstration
    errors_cm: tuple[float, ...] = ()


@dataclass(frozen=True)
class Learning:
    """One learning, or one growth of the network.

    Attributes:
        entry: The notebook's entry that was learned; 0 for growth.
        loop: The last loop that its experience carries.
        before: The number of the learner that was there before.
        error_cm: The imitation's error afterwards [cm]; None for growth.
    """

    entry: int
    loop: int
    before: int
    error_cm: float | None


@dataclass(frozen=True)
class Notebook:
    """Entries and learnings, the oldest first; `next` numbers the next entry."""

    entries: tuple[Entry, ...] = ()
    learned: tuple[Learning, ...] = ()
    next: int = 1

    def entry(self, number: int) -> Entry | None:
        """Return the entry of a number, or None if there is none (any more)."""
        return next((e for e in self.entries if e.number == number), None)

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

    def latest(self) -> tuple[Entry, ...]:
        """Return the latest entry of every motion."""
        return tuple({e.motion: e for e in self.entries}.values())

    @property
    def curve(self) -> tuple[float, ...]:
        """The imitation error after every learning [cm]."""
        return tuple(each.error_cm for each in self.learned if each.error_cm is not None)

    @property
    def last_loop(self) -> int:
        """The latest loop of a learning; 0 before the first."""
        return max((each.loop for each in self.learned), default=0)
