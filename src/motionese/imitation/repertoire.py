"""The repertoire of a level: what was learned while it was the top one; and who shares its states.

The initial states of a level belong to a single motion only while that level is the top one. Once a
level has opened above it, motions share the initial states of the element of its repertoire that
they begin with; a level that was never on top has one for all, as the fast context units of
Yamashita & Tani (2008) have. What a motion has beyond that element must then be told by the level
above. It is one rule for all courses of development: in the paper's TD/MD the elements of Cf are
the primitives, in TND/MD whole pairs, and with all levels from the start (MND) Cf has one state.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float
from numpy import ndarray

Sharing = Literal["repertoire", "first primitive", "none"]
"""Who shares a level's initial states: motions that begin with the same element of its repertoire,
once a level has opened above it; those that begin with the same primitive, always; nobody."""
Grouping = Literal["labels", "seen"]
"""How it is known what a motion begins with: as the caregiver calls it, or as it was seen."""


@dataclass(frozen=True)
class Element:
    """A motion of a level's repertoire.

    Attributes:
        level: The level that was the top one when it was learned.
        motion: The sequence's name.
        values: The own motion, in the channels' units. [T, D]
        initial_state: u_0 of all levels that were open. [n]
    """

    level: str
    motion: str
    values: Float[ndarray, "T D"]
    initial_state: Float[ndarray, " n"]


def element_called(elements: Iterable[Element], motion: str) -> str:
    """Return the longest element that a motion begins with, by name; itself if there is none.

    A sequence's name goes on with signs: 'wave again' does not begin with 'wave'.
    """
    within = [
        e.motion
        for e in elements
        if motion.startswith(e.motion)
        and not any(sign.isalnum() or sign == " " for sign in motion[len(e.motion) :])
    ]
    return max(within, key=len, default=motion)


def element_seen(
    elements: Iterable[Element], shown: Float[ndarray, "T D"], scale: Float[ndarray, " D"]
) -> str:
    """Return the element whose own motion is nearest to the beginning of what was shown.

    Args:
        elements: The elements.
        shown: What was seen; NaN where nothing was, as of the joints. [T, D]
        scale: What differences of a channel are divided by.
    """

    def distance(element: Element) -> float:
        rows = min(len(shown), len(element.values))
        return float(np.nanmean(((shown[:rows] - element.values[:rows]) / scale) ** 2))

    return min(elements, key=distance).motion


def first_primitive(motion: str) -> str:
    """Return the name of the sequence's first primitive: 'UR ↓' of 'UR ↓↑'."""
    start, space, signs = motion.partition(" ")
    return start + space + signs[:1]
