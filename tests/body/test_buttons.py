"""Buttons: pressed through contact by either hand, and by nothing else."""

import numpy as np
import pytest

from motionese.body.actroid import Actroid, ActroidSettings, reach
from motionese.errors import TaskError
from motionese.task import PUSHING_BUTTONS
from motionese.task.pushing_buttons import PRESSED_MM

BUTTON = {"LR": "right_button", "LL": "left_button"}
at = PUSHING_BUTTONS.position


class Deepest(dict):
    """The deepest that each button was since the beginning."""

    def look(self, body):
        for name, depth in body.effects().items():
            self[name] = max(depth, self.get(name, 0.0))


def other(button):
    return next(name for name in BUTTON.values() if name != button)


@pytest.mark.parametrize("stiffness", [15.0, 30.0, 80.0])
@pytest.mark.parametrize(("start", "end"), [("UR", "LR"), ("UL", "LL")])
def test_push_presses_its_button_and_raise_lets_it_go(stiffness, start, end, minimum_jerk, rng):
    body = Actroid(ActroidSettings(stiffness=stiffness), PUSHING_BUTTONS)
    up, down = (body.command_reaching(at(c)) for c in (start, end))
    body.reset(up, rng)
    assert max(body.effects().values()) < 0.1
    deepest = Deepest()
    for share in [*minimum_jerk, 1.0, 1.0, 1.0, 1.0]:
        body.command(up + share * (down - up))
        body.step()
        deepest.look(body)
    assert 1.8 * PRESSED_MM < deepest[BUTTON[end]] < 15.5
    assert deepest[other(BUTTON[end])] < 0.1
    for share in [*minimum_jerk, 1.0, 1.0, 1.0, 1.0]:
        body.command(down + share * (up - down))
        body.step()
    assert max(body.effects().values()) < 0.1


@pytest.mark.parametrize("corner", PUSHING_BUTTONS.places)
def test_command_reaching_a_corner_presses_its_button_alone(body, corner, rng):
    body.reset(body.command_reaching(at(corner)), rng)
    for name, depth in body.effects().items():
        assert depth == pytest.approx(13.0 if BUTTON.get(corner) == name else 0.0, abs=0.5)


def test_pressed_button_bends_the_arm(body, rng):
    angles = reach.arm_nearest(at("LR"))
    further = np.degrees(body.command_reaching(at("LR")) - angles)[0]
    assert 1.5 < further < 3
    body.reset(angles, rng)
    assert body.effects()["right_button"] < PRESSED_MM


def test_upper_corners_press_nothing(body, minimum_jerk, rng):
    right, left = (reach.arm_nearest(at(corner)) for corner in ("UR", "UL"))
    body.reset(right, rng)
    deepest = Deepest()
    for share in minimum_jerk:
        body.command(right + share * (left - right))
        body.step()
        deepest.look(body)
    assert max(deepest.values()) < 0.1


@pytest.mark.parametrize(("start", "end"), [("UR", "LR"), ("UL", "LL")])
def test_caregiver_presses_as_deep_as_the_robot(body, start, end, minimum_jerk, rng):
    body.watch(at(start), rng)
    assert max(body.effects().values()) < 0.1
    for share in minimum_jerk:
        body.move_caregiver(body.reachable(at(start) + share * (at(end) - at(start))))
        body.step()
    np.testing.assert_allclose(body.caregiver_position(), at(end), atol=1e-12)
    assert body.effects()[BUTTON[end]] == pytest.approx(13, abs=0.5)
    assert body.effects()[other(BUTTON[end])] < 0.1


def test_position_below_the_pressed_button_is_refused(body):
    deep = reach.projected(at("LR") - [0.0, 0.0, 0.05])
    with pytest.raises(TaskError, match=r"place LR .* is [1-9].* cm out of the arm's reach"):
        body.command_reaching(deep, name="place LR")
