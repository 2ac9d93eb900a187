"""Where a lesson asks for memory of order: motions that go on in different ways.

After the same beginning, of one stroke at least, two motions of a lesson may go on in different
ways. The stroke that then differs is ambiguous: nothing that is seen tells which it is, only what
has been remembered since the motion began.
"""

from collections.abc import Sequence
from itertools import permutations

import numpy as np

from motionese.task import PrimitiveSequence, common_beginning

NO_CHOICE = (
    "No two motions of the lesson start in the same place with different strokes, so whose first "
    "stroke is made cannot be asked."
)
NO_BRANCH = (
    "No two motions of the lesson go on in different ways after the same beginning: it asks for no "
    "memory of order, and of order there is nothing to exchange, to take away or to decode."
)

Lesson = Sequence[PrimitiveSequence]


def branches(lesson: Lesson) -> dict[tuple[str, int], tuple[str, ...]]:
    """Return by motion and ambiguous stroke, from 2, all ways on after the same beginning.

    Motions and ways on, of one primitive each, go by the names of their sequences.
    """
    found: dict[tuple[str, int], set[str]] = {}
    for one, other in permutations(lesson, 2):
        stroke = common_beginning(one.name, other.name)
        if 1 < stroke <= min(len(one.primitives), len(other.primitives)):
            ways = (PrimitiveSequence((s.primitives[stroke - 1],)).name for s in (one, other))
            found.setdefault((one.name, stroke), set()).update(ways)
    return {where: tuple(sorted(ways)) for where, ways in found.items()}


def ways_on(lesson: Lesson) -> dict[str, tuple[str, ...]]:
    """Return, by first primitive, the ways on where motions that begin with it part after it."""
    first = {s.name: PrimitiveSequence(s.primitives[:1]).name for s in lesson}
    return {first[motion]: ways for (motion, n), ways in branches(lesson).items() if n == 2}


def branch_chance(lesson: Lesson) -> float:
    """Return the share of ambiguous strokes that are right by chance; NaN where there are none."""
    shares = [1 / len(ways) for ways in branches(lesson).values()]
    return float(np.mean(shares)) if shares else np.nan


def without_cases(lesson: Lesson) -> list[str]:
    """Return a sentence about whatever a lesson has no case of."""
    choice = any(common_beginning(a.name, b.name) == 1 for a, b in permutations(lesson, 2))
    return [NO_CHOICE] * (not choice) + [NO_BRANCH] * (not branches(lesson))
