"""The view: what is drawn and what is seen are the same places."""

import numpy as np
import pytest

from motionese.body import CORNERS, bearing
from motionese.body.gaze import aimed_at
from motionese.body.reach import REACH_M, SHOULDER
from motionese.teaching.reading import hand_seen
from motionese.teaching.view import View


def test_the_corners_lie_as_they_do_before_the_robot():
    places = {name: View().of_points(place) for name, place in CORNERS.items()}
    assert all((place > 0.1).all() and (place < 0.9).all() for place in places.values())
    assert places["UR"][0] - places["UL"][0] > 0.3, "the robot's right is on the right"
    assert places["LR"][1] - places["UR"][1] > 0.3, "buttons are below"


@pytest.mark.parametrize("corner", sorted(CORNERS))
def test_a_drawn_corner_is_the_corner(corner):
    view = View()
    positions, strayed = view.positions(view.of_points(CORNERS[corner])[None])
    np.testing.assert_allclose(positions[0], CORNERS[corner], atol=1e-9)
    assert not strayed[0]


def test_points_out_of_reach_become_the_nearest_that_the_arm_reaches():
    positions, strayed = View().positions(np.array([[-1.0, 2.0], [2.0, -1.0], [0.5, 0.5]]))
    np.testing.assert_allclose(np.linalg.norm(positions - SHOULDER, axis=1), REACH_M)
    assert strayed.tolist() == [True, True, False]


def test_a_direction_is_seen_where_its_point_is():
    view, point = View(), CORNERS["LL"]
    pan, tilt = aimed_at(point)
    values = np.array([0.0, 0.0, pan, tilt, 0.0, 0.0])
    np.testing.assert_allclose(view.of_bearing(bearing(values)), view.of_points(point), atol=1e-9)
    np.testing.assert_allclose(hand_seen(values), point, atol=1e-9)


def test_the_axes_are_at_right_angles():
    axes = View().axes
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), -axes[2], atol=1e-12)
