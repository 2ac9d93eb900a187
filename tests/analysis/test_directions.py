"""Uniformity of directions and what sets them, on maps whose makers are known."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.analysis.directions import (
    direction_shares,
    following,
    resultant_length,
    share_within,
    true_strokes,
)
from motionese.body.actroid import Actroid
from motionese.task import PUSHING_BUTTONS

P, G = 5, 225
CF = np.linspace(-3, 3, P)[:, None]
CS = np.linspace(-3, 3, G)[None]


def test_directions_set_by_held_alone():
    shares = direction_shares(CF + 0 * CS)
    assert (shares.by_held, shares.by_varied) == pytest.approx((1, 0))
    assert resultant_length(CF + 0 * CS) == pytest.approx(np.ones(P))


def test_directions_set_by_varied_alone():
    shares = direction_shares(0 * CF + CS)
    assert (shares.by_held, shares.by_varied) == pytest.approx((0, 1))


def test_small_turns_add_up():
    """Where directions differ little, unit vectors are straight: variances of the angles count."""
    cf, cs = 0.02 * CF, 0.01 * CS
    shares = direction_shares(cf + cs)
    total = cf.var() + cs.var()
    assert shares.by_held == pytest.approx(cf.var() / total, abs=0.01)
    assert shares.by_varied == pytest.approx(cs.var() / total, abs=0.01)
    assert shares.together == pytest.approx(1, abs=0.01)


def test_pure_interaction_is_explained_by_neither():
    shares = direction_shares(np.array([[0.0, math.pi], [math.pi, 0.0]]))
    assert (shares.by_held, shares.by_varied) == pytest.approx((0, 0), abs=1e-12)


def test_random_directions():
    """Without any effect a factor explains what its degrees of freedom are of all."""
    directions = np.random.default_rng(2).uniform(-math.pi, math.pi, (P, G))
    shares = direction_shares(directions)
    assert shares.by_held == pytest.approx((P - 1) / (P * G - 1), abs=0.01)
    assert shares.by_varied == pytest.approx((G - 1) / (P * G - 1), abs=0.05)
    assert resultant_length(directions).max() < 0.2


@given(st.integers(0, 10_000), st.floats(-7, 7))
def test_shares_are_shares_whatever_the_frame(seed, turn):
    directions = np.random.default_rng(seed).uniform(-math.pi, math.pi, (3, 9))
    shares, turned = direction_shares(directions), direction_shares(directions + turn)
    assert shares.by_held >= 0 and shares.by_varied >= 0 and shares.together <= 1 + 1e-9
    assert (turned.by_held, turned.by_varied) == pytest.approx((shares.by_held, shares.by_varied))


def test_one_direction_everywhere_has_no_variance_to_explain():
    assert math.isnan(direction_shares(np.full((P, G), 1.3)).by_held)


def test_resultant_length_does_not_break_at_pi():
    assert resultant_length(np.array([math.pi - 0.01, -math.pi + 0.01])) > 0.999
    assert resultant_length(np.array([0.0, math.pi])) == pytest.approx(0, abs=1e-12)
    assert resultant_length(np.array([0.0, math.pi / 2])) == pytest.approx(math.sqrt(0.5))


def test_share_within_45_degrees():
    directions = np.radians([170, -170, -140, 90, 100])
    assert share_within(directions, [math.pi]) == pytest.approx(3 / 5)
    assert share_within(directions, [math.pi, math.pi / 2]) == 1


def test_true_strokes_as_the_robot_sees_them():
    strokes = true_strokes(PUSHING_BUTTONS, Actroid.eye_position)
    direction = {name: angle for name, (angle, _) in strokes.items()}
    assert direction["UR ↓"] == pytest.approx(-math.pi / 2, abs=0.3)
    assert direction["LL ↑"] == pytest.approx(math.pi / 2, abs=0.3)
    assert abs(direction["UR ←"]) == pytest.approx(math.pi, abs=0.3)
    # A button lies some 25 cm below the hand, some 60 cm from the eye.
    assert all(0.2 < extent < 0.5 for _, extent in strokes.values())


def test_places_of_the_settings_count():
    task = PUSHING_BUTTONS.with_places({"UL": (0.5, -0.3, 1.2)})
    assert true_strokes(task, Actroid.eye_position)["UR ←"][0] == pytest.approx(
        math.pi / 2, abs=0.5
    )


def test_what_may_follow():
    assert following(PUSHING_BUTTONS, "UR ↓") == ("LR ↑",)
    assert set(following(PUSHING_BUTTONS, "LR ↑")) == {"UR ↓", "UR ←"}
