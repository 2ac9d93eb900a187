"""Errors in centimetres and presses, against cases whose answer is known."""

import numpy as np
import pytest

from motionese.body import EYE_POSITION, Actroid, BodySettings
from motionese.caregiver import PUSHING_BUTTONS, Demonstrating
from motionese.experiment.measures import path_error_cm, press_depths_mm, pressed, seen_error_cm

MANNER = Demonstrating(stroke_steps=12, rest_steps=2, variability_mm=0.0, persistence=0.0)


def test_path_error_is_the_mean_distance():
    shown = np.zeros((4, 3))
    performed = np.array([[0.01, 0, 0], [0, 0.02, 0], [0, 0, 0.03], [0.03, 0.04, 0]])
    assert path_error_cm(performed, shown) == pytest.approx((1 + 2 + 3 + 5) / 4)


def test_seen_error_is_the_distance_across_the_line_of_sight():
    body = Actroid(BodySettings(pixel_noise=0.0))
    rng = np.random.default_rng(0)
    hands, seen = [], []
    for arm in ([0.2, 0.0], [0.25, 0.02]):
        body.reset(np.array(arm), rng)
        hands.append(body.hand_position())
        seen.append(body.sense())
    one, other = (hand - EYE_POSITION for hand in hands)
    angle = np.arccos(one @ other / np.linalg.norm(one) / np.linalg.norm(other))
    expected = 100 * angle * np.linalg.norm(one)
    measured = seen_error_cm(seen[0][None], seen[1][None], hands[0][None])
    assert measured == pytest.approx(expected, rel=1e-3)
    assert seen_error_cm(seen[0][None], seen[0][None], hands[0][None]) == 0.0


@pytest.mark.parametrize(
    ("motion", "row", "button", "reached"),
    [
        ("UR ↓", 12, 0, [9.0]),
        ("UR ↓", 12, 1, [0.0]),
        ("UR ↓", 3, 0, [0.0]),
        ("UR ↓↑", 16, 0, [9.0]),
        ("UR ←↓", 26, 1, [9.0]),
        ("LR ↑↓↑", 0, 0, [0.0]),
        ("LR ↑↓↑", 27, 0, [9.0]),
        ("UR ↓↑↓", 13, 0, [9.0, 0.0]),
        ("UR ↓↑↓", 41, 0, [0.0, 9.0]),
        ("LR ↑", 5, 0, []),
    ],
)
def test_a_press_counts_for_the_stroke_that_should_make_it(motion, row, button, reached):
    motion = PUSHING_BUTTONS.motion(motion)
    depths = np.zeros((MANNER.rows(motion), 2))
    depths[row, button] = 9.0
    assert press_depths_mm(motion, depths, MANNER) == reached
    assert pressed(reached) == sum(depth > 0 for depth in reached)


def test_a_touch_is_no_press():
    assert pressed([4.9, 5.1, 0.0]) == 1
