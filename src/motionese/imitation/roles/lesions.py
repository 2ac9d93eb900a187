"""Lesions: what a motion loses with a level's initial state, or with what a level hears from above.

A level whose initial state is its mean over the motions of the lesson no longer tells them apart; a
level that is cut off from the one below is not heard at all, whatever it holds.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.loop import Row
from motionese.imitation.roles.recognised import RecognisedLesson
from motionese.imitation.strokes import near
from motionese.network import MTRNN


def lesioned(lesson: RecognisedLesson) -> list[Row]:
    """Let the network generate a lesson's motions, intact and with each lesion.

    A stroke is right if it goes within 45° of where the demonstration's goes. It is ambiguous if
    another motion of the lesson goes on otherwise from the same beginning.

    Returns:
        A row per lesion, demonstration and stroke; none for a lesson of a single motion, which
        there is nothing to tell from.
    """
    shown = lesson.usable
    if len({each.sequence for each in shown}) < 2:
        return []
    states = np.array([each.initial_state for each in shown])
    return [
        {
            "motion": each.sequence.name,
            "demonstration": each.number,
            "lesion": lesion,
            "stroke": stroke + 1,
            "ambiguous": lesson.ambiguous(each.sequence, stroke),
            "right": near(float(made), float(true)),
        }
        for lesion, network, begin in _lesions(lesson.network, states)
        for each, strokes in zip(shown, lesson.generated(network, begin, shown), strict=True)
        for stroke, (made, true) in enumerate(zip(strokes, each.directions, strict=True))
    ]


def _lesions(
    network: MTRNN, states: Float[ndarray, "K N"]
) -> Iterator[tuple[str, MTRNN, Float[ndarray, "K N"]]]:
    """Yield every lesion's name, the network, and the states it begins in; the first is none."""
    yield "none", network, states
    context = network.names[1:]
    for level in context:
        units, mean = network.units(level), states.copy()
        mean[:, units] = states[:, units].mean(axis=0)
        yield f"{level}_0 to its mean", network, mean
    for below, above in pairwise(context):
        block = network.units(below), network.units(above)
        cut = replace(network, weights=network.weights.at[block].set(0.0))
        yield f"{above} → {below} cut", cut, states
