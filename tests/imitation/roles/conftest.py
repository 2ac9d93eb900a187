"""The lesson of the networks written by hand, as if they had recognised its demonstrations."""

import numpy as np
import pytest
from by_hand.role_networks import (
    BEGINS,
    CROSSING,
    DIRECTIONS,
    FIRST,
    MOTIONS,
    ROWS,
    bearing,
    role_network,
    sequence_of,
)

from motionese.imitation.roles import RecognisedDemonstration, RecognisedLesson
from motionese.learning import generate


@pytest.fixture(scope="session")
def lesson_of():
    return recognised_by_hand


def recognised_by_hand(name, motions=MOTIONS, demonstrations=2, scatter=0.3):
    """Demonstrations that are recognised up to a scatter (sd of every context unit's u_0)."""
    made, rng = role_network(name), np.random.default_rng(1)
    shown = []
    for motion in motions:
        path = generate(made.network, made.states[motion], ROWS, first=FIRST)
        for number in range(1, demonstrations + 1):
            state = made.states[motion].copy()
            state[2:] += scatter * rng.normal(size=len(state) - 2)
            parts = (number, state, FIRST, BEGINS, bearing(path))
            shown.append(RecognisedDemonstration(sequence_of(motion), *parts))
    primitives = {p: DIRECTIONS[p.words] for p in CROSSING.primitives}
    return RecognisedLesson(made.network, bearing, tuple(shown), primitives)
