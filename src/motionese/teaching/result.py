"""What an imitation came to: how near it was to what was shown, and whether it did what is due."""

from dataclasses import dataclass
from typing import Literal

from motionese.imitation import Performance, Watched, path_error_cm
from motionese.task import PrimitiveSequence, Task, due_effects

WELL_CM = 2.0
"""An imitation that misses by less is good: the hand of a person who shows it is no steadier."""


@dataclass(frozen=True)
class Push:
    """A push that was due.

    Attributes:
        effect: What it has to bring about, as the body names it.
        place: Where.
        depth_mm: How deep it was [mm].
        needed_mm: How deep it must be [mm].
    """

    effect: str
    place: str
    depth_mm: float
    needed_mm: float

    @property
    def made(self) -> bool:
        """Whether it was deep enough."""
        return self.depth_mm > self.needed_mm

    @property
    def sentence(self) -> str:
        """It in words."""
        if self.made:
            return (
                f"pressed {self.place}: {self.depth_mm:.1f} mm of the {self.needed_mm:g} it needs"
            )
        if not round(self.depth_mm, 1):
            return f"did not press {self.place}"
        return f"pressed {self.place} {self.depth_mm:.1f} mm; {self.needed_mm:g} are needed"


@dataclass(frozen=True)
class Result:
    """What an imitation came to: its error [cm], and the pushes that were due, in order."""

    error_cm: float
    pushes: tuple[Push, ...] = ()

    @property
    def missed(self) -> int:
        """How many pushes failed that were due."""
        return sum(not push.made for push in self.pushes)

    @property
    def good(self) -> bool:
        """Whether it was near enough and did all that is due."""
        return self.error_cm <= WELL_CM and not self.missed

    @property
    def advice(self) -> Literal["learn", "show"]:
        """What to do now: practise it, or show another motion."""
        return "show" if self.good else "learn"

    @property
    def pressed(self) -> str:
        """In words the first push that failed, or else the last; empty where none was due."""
        failed = [push for push in self.pushes if not push.made]
        return next((push.sentence for push in (*failed, *reversed(self.pushes))), "")

    @property
    def sentence(self) -> str:
        """It in words."""
        missed = f"It missed by {self.error_cm:.1f} cm"
        joined = f"{missed} and {self.pressed}." if self.pressed else f"{missed}."
        return f"{joined} It does this well." if self.good else joined


def result_of(
    performance: Performance, watched: Watched, sequence: PrimitiveSequence | None, task: Task
) -> Result:
    """Return what an imitation of a sequence of a task, or of another motion, came to."""
    rows, effects = len(watched.path), performance.effects
    due = due_effects(sequence, watched.begins, rows) if sequence else []
    pushes = [
        Push(
            primitive.effect,
            primitive.end,
            float(effects[primitive.effect][window].max()),
            task.needed_mm,
        )
        for primitive, window in due
    ]
    return Result(path_error_cm(performance.path, watched.path), tuple(pushes))
