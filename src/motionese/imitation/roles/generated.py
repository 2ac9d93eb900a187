"""Recognised motions as the network generates them, with what goes on inside."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.roles.recognised import RecognisedLesson
from motionese.learning import activity, generate
from motionese.task import PrimitiveSequence


@dataclass(frozen=True)
class GeneratedMotion:
    """A motion that a network generates in closed loop, from the state that it recognised.

    Attributes:
        sequence: What was shown.
        number: Which of its demonstrations was recognised, from 1.
        begins: The rows at which its primitives begin in the demonstration.
        seen: Azimuth and elevation [rad] at which the generated hand is seen. [T, 2]
        activity: The output y of every unit. [T, N]
    """

    sequence: PrimitiveSequence
    number: int
    begins: tuple[int, ...]
    seen: Float[ndarray, "T 2"]
    activity: Float[ndarray, "T N"]

    @property
    def signs(self) -> list[str]:
        """The sign of the primitive under way, row by row."""
        places = np.searchsorted(self.begins, np.arange(len(self.activity)), side="right") - 1
        return [self.sequence.primitives[place].sign for place in places]

    def strokes(self, units: slice) -> Iterator[tuple[str, Float[ndarray, "_ n"]]]:
        """Yield every primitive's name, and the activity of some units while it is under way."""
        parts = np.split(self.activity[:, units], self.begins[1:])
        yield from zip((p.name for p in self.sequence.primitives), parts, strict=True)


def generated(lesson: RecognisedLesson) -> list[GeneratedMotion]:
    """Let the network generate every usable demonstration of a lesson."""
    shown = lesson.usable
    if not shown:
        return []
    states, firsts = (np.array([getattr(d, n) for d in shown]) for n in ("initial_state", "first"))
    rows = max(len(d.seen) for d in shown)
    paths = lesson.bearing(generate(lesson.network, states, rows, first=firsts))
    inside = activity(lesson.network, states, rows, first=firsts).astype(float)
    return [
        GeneratedMotion(d.sequence, d.number, d.begins, path[: len(d.seen)], y[: len(d.seen)])
        for d, path, y in zip(shown, paths, inside, strict=True)
    ]
