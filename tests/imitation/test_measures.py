"""Errors in centimetres, against cases whose answer is known."""

import numpy as np
import pytest

from motionese.body import open_body
from motionese.body.actroid import ActroidSettings
from motionese.imitation.measures import path_error_cm, seen_error_cm
from motionese.task import PUSHING_BUTTONS


def test_path_error_is_the_mean_distance():
    shown = np.zeros((4, 3))
    performed = np.array([[0.01, 0, 0], [0, 0.02, 0], [0, 0, 0.03], [0.03, 0.04, 0]])
    assert path_error_cm(performed, shown) == pytest.approx((1 + 2 + 3 + 5) / 4)


def test_seen_error_is_the_distance_across_the_line_of_sight():
    body = open_body(ActroidSettings(pixel_noise=0.0), PUSHING_BUTTONS)
    rng = np.random.default_rng(0)
    hands, seen = [], []
    for arm in ([0.2, 0.0], [0.25, 0.02]):
        body.reset(np.array(arm), rng)
        hands.append(body.hand_position())
        seen.append(body.sense())
    one, other = (hand - body.eye_position for hand in hands)
    angle = np.arccos(one @ other / np.linalg.norm(one) / np.linalg.norm(other))
    expected = 100 * angle * np.linalg.norm(one)
    measured = seen_error_cm(body, seen[0][None], seen[1][None], hands[0][None])
    assert measured == pytest.approx(expected, rel=1e-3)
    assert seen_error_cm(body, seen[0][None], seen[0][None], hands[0][None]) == 0.0
