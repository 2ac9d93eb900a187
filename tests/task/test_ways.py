"""Ways begin and end at their places, and arcs are circles."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from motionese.task import SHAPES, Arc, ViaPoints, straight
from motionese.task.shapes import AWAY, MIDDLE, RADIUS_CM

START, END = np.array([0.5, 0.1, 0.9]), np.array([0.5, -0.1, 1.0])
AXIS = (1.0, 0.0, 0.0)
SHARE = np.linspace(0, 1, 21)


@given(st.floats(0.2, 6.0))
def test_every_way_leads_from_start_to_end(angle):
    for way in (straight, Arc(angle, AXIS), Arc(-angle, AXIS), ViaPoints(((0.1, 0, 0),))):
        np.testing.assert_allclose(way(SHARE, START, END)[[0, -1]], [START, END], atol=1e-12)


@given(st.floats(0.2, 6.0))
def test_an_arc_keeps_its_radius_and_its_length(angle):
    path = Arc(angle, AXIS)(SHARE, START, END)
    chord = np.linalg.norm(END - START)
    radius = chord / 2 / abs(np.sin(angle / 2))
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    np.testing.assert_allclose(steps, 2 * radius * np.sin(angle / 40), rtol=1e-9)
    np.testing.assert_allclose(path[:, 0], 0.5, atol=1e-12)


def test_a_half_circle_passes_beside_its_middle():
    middle = Arc(np.pi, AXIS)(np.array([0.5]), START, END)[0]
    across = np.cross(AXIS, END - START) / 2
    np.testing.assert_allclose(middle, (START + END) / 2 - across, atol=1e-12)


def test_via_points_lie_beside_the_straight_way():
    path = ViaPoints(((0.0, 0.0, 0.2), (0.0, 0.0, 0.0)))(np.array([1 / 3, 2 / 3]), START, END)
    beside = path - straight(np.array([1 / 3, 2 / 3]), START, END)
    np.testing.assert_allclose(beside, [[0, 0, 0.2], [0, 0, 0]], atol=1e-12)


def test_the_circle_of_the_shapes_is_one():
    circle = SHAPES.sequence("T ◝◡◜")
    path = np.concatenate(
        [p.way(SHARE, SHAPES.position(p.start), SHAPES.position(p.end)) for p in circle.primitives]
    )
    beyond = path - np.array(MIDDLE)
    np.testing.assert_allclose(np.linalg.norm(beyond, axis=1), RADIUS_CM / 100, atol=1e-5)
    np.testing.assert_allclose(beyond @ np.array(AWAY), 0, atol=1e-5)
