"""Limits: within the range, not faster than allowed, counted."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.errors import ControlError
from motionese.runtime import Limits
from motionese.runtime.limits import Limiter

RATE_HZ = 20.0


@given(seed=st.integers(0, 2**32 - 1), speed=st.floats(0.1, 50.0))
def test_commands_stay_within_their_ranges_and_speeds(model, seed, speed):
    limits = Limits(ranges={"lift": (-0.5, 0.5)}, speeds={"lift": speed, "turn": 10 * speed})
    limiter = Limiter(model, limits, RATE_HZ)
    rng = np.random.default_rng(seed)
    before, sent = np.array([0.1, 3.0, 0.4]), []

    for wanted in rng.normal(0.0, [1.0, 100.0, 1.0], (50, 3)):
        before = limiter.limit(wanted, before)
        sent.append(before)

    sent = np.array([[0.1, 3.0, 0.4], *sent])
    assert (sent >= [-0.5, -90.0, 0.0]).all()
    assert (sent <= [0.5, 45.0, 1.0]).all()
    steps = np.abs(np.diff(sent, axis=0)).max(0)
    assert (steps[:2] <= np.array([speed, 10 * speed]) / RATE_HZ + 1e-9).all()


def test_what_took_hold_is_counted(model):
    limiter = Limiter(model, Limits(speeds={"lift": 2.0}), RATE_HZ)
    before = np.array([0.0, 0.0, 0.5])

    got = [limiter.limit(np.array(wanted), before) for wanted in ([3, 0, 0.5], [0.1, 50, -1])]

    np.testing.assert_allclose(got, [[0.1, 0.0, 0.5], [0.1, 45.0, 0.0]])
    assert limiter.clamped == {"lift": 1, "turn": 1, "grip": 1}
    assert limiter.slowed == {"lift": 1, "turn": 0, "grip": 0}


def test_a_robot_beyond_its_range_is_led_back_at_its_speed(model):
    limiter = Limiter(model, Limits(speeds={"lift": 2.0}), RATE_HZ)

    np.testing.assert_allclose(
        limiter.limit(np.array([1.9, 0.0, 0.5]), np.array([2.5, 0.0, 0.5])), [2.4, 0.0, 0.5]
    )


@pytest.mark.parametrize(
    ("limits", "match"),
    [
        (Limits(ranges={"lfit": (0.0, 1.0)}), "limits: unknown channel 'lfit'; did you mean"),
        (Limits(ranges={"lift": (1.0, 1.0)}), "'lift': its limits must be low < high, got 1 to 1"),
        (Limits(ranges={"lift": (np.nan, 1.0)}), "limits must be low < high, got nan to 1"),
        (Limits(speeds={"grip": 0.0}), "channel 'grip': its speed must be > 0, got 0"),
        (Limits(speeds={"grip": np.nan}), "channel 'grip': its speed must be > 0, got nan"),
    ],
)
def test_limits_that_cannot_be_are_refused(model, limits, match):
    with pytest.raises(ControlError, match=match):
        Limiter(model, limits, RATE_HZ)
