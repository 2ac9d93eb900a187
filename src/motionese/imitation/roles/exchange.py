"""Exchange of recognised initial states: whose stroke follows when levels are of two motions?

The initial states of the levels up to a split are those of one motion, "lower", the ones above
those of another, "upper"; the network generates in closed loop from the lower one's first row. In a
stroke that the two motions have in different directions it then shows which levels decide.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import permutations, product
from typing import Literal

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.loop import Row
from motionese.imitation.roles.recognised import RecognisedDemonstration, RecognisedLesson
from motionese.imitation.strokes import near
from motionese.network import MTRNN

Kind = Literal["first", "order", "transfer"]


@dataclass(frozen=True)
class Case:
    """A stroke of which two motions say different things.

    Attributes:
        lower: Whose initial states the levels up to the split have.
        upper: Whose initial states the levels above have.
        kind: What is asked, see `exchanged`.
        stroke: Which stroke, from 0.
        directions: Where it goes [rad] by the lower and by the upper motion.
    """

    lower: RecognisedDemonstration
    upper: RecognisedDemonstration
    kind: Kind
    stroke: int
    directions: tuple[float, float]

    def follows(self, direction: float) -> str:
        """Return which of the two a direction [rad] follows: it is within 45° of that one alone."""
        lower, upper = (near(direction, own) for own in self.directions)
        if lower == upper:
            return "neither"
        return "lower" if lower else "upper"


def exchanged(lesson: RecognisedLesson) -> list[Row]:
    """Exchange the levels of every two motions of a lesson, and tell whose strokes follow.

    Every ordered pair is judged in what can be told apart, strokes that differ by more than 45°:

    - "first": both start in the same place, and differ in their first stroke.
    - "order": both start in the same place, and this is the first stroke that differs; only
      memory can tell it.
    - "transfer": their first strokes differ, and where the lower one's ends the task allows
      several, one of which has the sign of the upper one's second. The upper one's is ambiguous: if
      its levels hold the order, as a thing of its own, the stroke of that sign follows.

    Returns:
        A row per split, demonstration and case; none where no two motions differ, or where there
        is but one context level.
    """
    network = lesson.network
    pairs = permutations(lesson.usable, 2)
    cases = [
        case
        for lower, upper in pairs
        if lower.number == upper.number and lower.sequence != upper.sequence
        for case in (*_differing(lower, upper), *_transferred(lesson, lower, upper))
        if not near(*case.directions)
    ]
    tried = list(product([level.name for level in network.levels[1:-1]], cases))
    if not tried:
        return []
    states = [_mixed(network, split, case) for split, case in tried]
    made = lesson.generated(network, np.array(states), [case.lower for _, case in tried])
    return [
        {
            "motion_lower": case.lower.sequence.name,
            "motion_upper": case.upper.sequence.name,
            "demonstration": case.lower.number,
            "split": split,
            "kind": case.kind,
            "stroke": case.stroke + 1,
            "follows": case.follows(float(directions[case.stroke])),
        }
        for (split, case), directions in zip(tried, made, strict=True)
    ]


def _differing(lower: RecognisedDemonstration, upper: RecognisedDemonstration) -> Iterator[Case]:
    """Yield the first stroke in which two motions from one place differ."""
    strokes = enumerate(zip(lower.sequence.primitives, upper.sequence.primitives, strict=False))
    stroke = next((i for i, (own, other) in strokes if own != other), None)
    if stroke is not None and lower.sequence.start == upper.sequence.start:
        both = float(lower.directions[stroke]), float(upper.directions[stroke])
        yield Case(lower, upper, "order" if stroke else "first", stroke, both)


def _transferred(
    lesson: RecognisedLesson, lower: RecognisedDemonstration, upper: RecognisedDemonstration
) -> Iterator[Case]:
    """Yield the second stroke of one motion where the order of another may be applied to it."""
    own, others = lower.sequence.primitives, upper.sequence.primitives
    if own[0] == others[0] or min(len(own), len(others)) < 2:
        return
    if not lesson.ambiguous(upper.sequence, 1):
        return
    on = {p.sign: angle for p, angle in lesson.primitives.items() if p.start == own[0].end}
    sign = others[1].sign
    if len(on) > 1 and sign in on:
        yield Case(lower, upper, "transfer", 1, (float(lower.directions[1]), on[sign]))


def _mixed(network: MTRNN, split: str, case: Case) -> Float[ndarray, " N"]:
    """Return the initial state whose levels up to a split are of one motion, the rest another's."""
    end = network.units(split).stop
    return np.concatenate([case.lower.initial_state[:end], case.upper.initial_state[end:]])
