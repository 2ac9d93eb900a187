"""Belief in learned motions: the forward algorithm, and what it makes of readings."""

import numpy as np
import pytest
from by_hand.belief import beliefs

from motionese.runtime.belief import NONE, Belief

RNG = np.random.default_rng(0)
MOTIONS = {
    "reach": np.linspace([0.2, 0.3, 0.5], [0.8, 0.4, 0.5], 12),
    "wave": np.linspace([0.2, 0.3, 0.5], [0.2, 0.8, 0.7], 9),
    "tap": np.full((1, 3), 0.6),
    "turn": np.linspace([0.8, 0.4, 0.5], [0.5, 0.8, 0.2], 2),
}


def believed(readings, motions=MOTIONS):
    belief = Belief(motions, 0.05)
    told = []
    for reading in readings:
        belief.observe(reading)
        told.append(dict(belief.shares))
    return belief, told


@pytest.mark.parametrize("seed", range(4))
def test_it_equals_the_forward_algorithm_by_hand(seed):
    rng = np.random.default_rng(seed)
    path = np.concatenate([MOTIONS["reach"][:7], MOTIONS["wave"][3:]])
    readings = path + rng.normal(0.0, 0.04, path.shape)
    readings[rng.uniform(size=path.shape) < 0.3] = np.nan
    readings[4] = np.nan

    _, told = believed(readings)

    expected = beliefs(list(MOTIONS.values()), readings, 0.05)
    got = [[each[name] for name in (*MOTIONS, NONE)] for each in told]
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-9)


def test_what_was_learned_is_believed_in_and_how_far_it_has_come():
    belief, told = believed(MOTIONS["wave"][:6] + RNG.normal(0.0, 0.02, (6, 3)))
    assert told[-1]["wave"] > 0.9
    assert belief.likeliest == ("wave", 5)


def test_what_was_never_learned_is_none_of_these():
    strange = np.linspace([0.85, 0.85, 0.85], [0.5, 0.15, 0.9], 8)
    _, told = believed(strange)
    assert told[-1][NONE] > 0.9


def test_without_readings_time_passes_and_little_is_known():
    _, told = believed([MOTIONS["reach"][0], *[np.full(3, np.nan)] * 200])
    assert max(told[-1].values()) < 0.7
    assert sum(told[-1].values()) == pytest.approx(1)


def test_far_readings_leave_numbers():
    with np.errstate(all="raise", under="ignore"):
        _, told = believed(np.tile([0.02, 0.98, 0.02], (40, 1)))
    assert told[-1][NONE] > 0.99
