"""Buttons: pressed through contact by either hand, and by nothing else."""

import numpy as np
import pytest

from motionese.body import CORNERS, PRESSED_MM, Actroid, BodySettings, arm_reaching, projected
from motionese.errors import TaskError

BUTTON = {"LR": 0, "LL": 1}


@pytest.mark.parametrize("stiffness", [15.0, 30.0, 80.0])
@pytest.mark.parametrize(("start", "end"), [("UR", "LR"), ("UL", "LL")])
def test_push_presses_its_button_and_raise_lets_it_go(stiffness, start, end, minimum_jerk, rng):
    body = Actroid(BodySettings(stiffness=stiffness))
    up, down = (body.command_reaching(CORNERS[c]) for c in (start, end))
    body.reset(up, rng)
    assert body.button_depths().max() < 0.1
    for share in [*minimum_jerk, 1.0, 1.0, 1.0, 1.0]:
        body.command(up + share * (down - up))
        body.step()
    pressed = body.deepest_press()
    assert 1.8 * PRESSED_MM < pressed[BUTTON[end]] < 15.5
    assert pressed[1 - BUTTON[end]] < 0.1
    for share in [*minimum_jerk, 1.0, 1.0, 1.0, 1.0]:
        body.command(down + share * (up - down))
        body.step()
    assert body.button_depths().max() < 0.1
    assert body.deepest_press()[BUTTON[end]] >= pressed[BUTTON[end]]


@pytest.mark.parametrize("corner", list(CORNERS))
def test_command_reaching_a_corner_settles_there(body, corner, rng):
    body.reset(body.command_reaching(CORNERS[corner]), rng)
    np.testing.assert_allclose(body.hand_position(), CORNERS[corner], atol=2e-4)
    depths = body.button_depths()
    expected = [13.0 if BUTTON.get(corner) == side else 0.0 for side in (0, 1)]
    np.testing.assert_allclose(depths, expected, atol=0.5)
    body.step()
    np.testing.assert_allclose(body.hand_position(), CORNERS[corner], atol=2e-4)


def test_pressed_button_bends_the_arm(body, rng):
    angles = arm_reaching(CORNERS["LR"])
    further = np.degrees(body.command_reaching(CORNERS["LR"]) - angles)[0]
    assert 1.5 < further < 3
    body.reset(angles, rng)
    assert body.button_depths()[0] < PRESSED_MM


def test_upper_corners_press_nothing(body, minimum_jerk, rng):
    right, left = arm_reaching(CORNERS["UR"]), arm_reaching(CORNERS["UL"])
    body.reset(right, rng)
    for share in minimum_jerk:
        body.command(right + share * (left - right))
        body.step()
    assert body.deepest_press().max() < 0.1


@pytest.mark.parametrize(("start", "end"), [("UR", "LR"), ("UL", "LL")])
def test_caregiver_presses_as_deep_as_the_robot(body, start, end, minimum_jerk, rng):
    body.watch(CORNERS[start], rng)
    assert body.button_depths().max() < 0.1
    for share in minimum_jerk:
        body.move_caregiver(projected(CORNERS[start] + share * (CORNERS[end] - CORNERS[start])))
        body.step()
    np.testing.assert_allclose(body.caregiver_position(), CORNERS[end], atol=1e-12)
    assert body.deepest_press()[BUTTON[end]] == pytest.approx(13, abs=0.5)
    assert body.deepest_press()[1 - BUTTON[end]] < 0.1


def test_caregiver_does_not_touch_the_robots_arm(body, rng):
    posture = arm_reaching(CORNERS["UR"])
    body.reset(posture, rng)
    body.move_caregiver(body.hand_position())
    for _ in range(5):
        body.step()
    np.testing.assert_allclose(body.sense()[:2], posture, atol=1e-6)


def test_position_below_the_pressed_button_is_refused(body):
    deep = projected(CORNERS["LR"] - [0.0, 0.0, 0.05])
    with pytest.raises(TaskError, match=r"corner LR .* is [1-9].* cm out of the arm's reach"):
        body.command_reaching(deep, name="corner LR")
