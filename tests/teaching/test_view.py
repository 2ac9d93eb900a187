"""The view: what is drawn and what is seen are the same places."""

import numpy as np
import pytest

from motionese.body import open_body
from motionese.experiment import read_settings
from motionese.teaching.view import View, hand_seen


@pytest.fixture(scope="module", params=["default", "shapes", "desk_arm"])
def seen(request):
    """A task, a robot at it, and its view."""
    settings = read_settings(request.param)
    task = settings.task.task()
    body = open_body(settings.body, task)
    return task, body, View(body, task)


def test_the_places_lie_as_they_do_before_the_robot(seen):
    task, _, view = seen
    places = {name: view.of_points(task.position(name)) for name in task.places}
    assert all((place > 0.09).all() and (place < 0.91).all() for place in places.values())
    assert places["UR"][0] - places["UL"][0] > 0.2, "the robot's right is on the right"
    assert places["LR"][1] - places["UR"][1] > 0.2, "what is low is below"


def test_places_far_apart_make_the_field_wider(seen):
    task, body, view = seen
    far = task.with_places({"UR": (0.5, -0.9, 1.3), "LL": (0.5, 0.5, 0.6)})
    wide = View(body, far)
    assert wide.height > view.height
    places = np.array([wide.of_points(far.position(name)) for name in far.places])
    assert places.min() > 0.09 and places.max() < 0.91


def test_a_drawn_place_is_the_place(seen):
    task, _, view = seen
    for name in task.places:
        place = task.position(name)
        positions, strayed = view.positions(view.of_points(place)[None])
        np.testing.assert_allclose(view.of_points(positions), view.of_points(place)[None])
        # The board of the shapes lies some mm away from what the arm reaches.
        assert np.linalg.norm(positions[0] - place) < 0.006
        assert not strayed[0]


def test_points_out_of_reach_become_the_nearest_that_the_arm_reaches(seen):
    positions, strayed = seen[2].positions(np.array([[-1.0, 2.0], [2.0, -1.0], [0.5, 0.5]]))
    np.testing.assert_allclose(seen[1].reachable(positions), positions, atol=1e-9)
    assert strayed.tolist() == [True, True, False]


def test_the_hand_that_is_watched_is_seen_where_it_is(seen):
    task, body, _ = seen
    place = task.position("LL")
    body.watch(place, np.random.default_rng(0))
    np.testing.assert_allclose(hand_seen(body, body.sense()), place, atol=0.005)


def test_the_axes_are_at_right_angles(seen):
    axes = seen[2].axes
    np.testing.assert_allclose(axes @ axes.T, np.eye(3), atol=1e-12)
    np.testing.assert_allclose(np.cross(axes[0], axes[1]), -axes[2], atol=1e-12)
