"""The repertoire of a level: what was learned while it was the top one; and who shares its states.

The initial states of a level belong to a single motion only while that level is the top one. Once a
level has opened above it, motions share the initial states of the element of its repertoire that
they begin with; a level that was never on top has one for all, as the fast context units of
Yamashita & Tani (2008) have. What a motion has beyond that element must then be told by the level
above. It is one rule for all courses of development: in the paper's TD/MD the elements of Cf are
the primitives, in TND/MD whole pairs, and with all levels from the start (MND) Cf has one state.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import lasting

Sharing = Literal["repertoire", "first primitive", "none"]
"""Who shares a level's initial states: motions that begin with the same element of its repertoire,
once a level has opened above it; those that begin with the same primitive, always; nobody."""
Grouping = Literal["labels", "seen", "pauses"]
"""How it is known what a motion begins with: as the caregiver calls it, as it was seen, or as it
was seen up to a pause."""


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


def element_to_a_pause(
    elements: Iterable[Element],
    shown: Float[ndarray, "T D"],
    scale: Float[ndarray, " D"],
    strokes: Callable[[Float[ndarray, "_ D"]], Sequence[tuple[int, int]]],
) -> str:
    """Return the element whose own strokes are nearest to as many first strokes of what was shown.

    Both are played as fast as each other: how long a stroke or a pause lasts does not matter.

    Args:
        elements: The elements.
        shown: What was seen; NaN where nothing was, as of the joints. [T, D]
        scale: What differences of a channel are divided by.
        strokes: The rows in which strokes begin and end, see `strokes_seen`.
    """
    parts = strokes(shown) or ((0, len(shown)),)

    def distance(element: Element) -> float:
        own = strokes(element.values) or ((0, len(element.values)),)
        first = shown[parts[0][0] : parts[min(len(own), len(parts)) - 1][1] + 1]
        whole = element.values[own[0][0] : own[-1][1] + 1]
        apart = (lasting(first, len(whole)) - whole) / scale
        return float(np.nanmean(apart**2))

    return min(elements, key=distance).motion


def first_primitive(motion: str) -> str:
    """Return the name of the sequence's first primitive: 'UR ↓' of 'UR ↓↑'."""
    start, space, signs = motion.partition(" ")
    return start + space + signs[:1]
