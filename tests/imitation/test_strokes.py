"""Directions of seen strokes, by cases that can be told by eye."""

import numpy as np
import pytest

from motionese.imitation.strokes import directions, near, stroke

RIGHT, UP, LEFT = np.array([-0.1, 0.0]), np.array([0.0, 0.1]), np.array([0.1, 0.0])
"""Ways, as azimuth to the left and elevation [rad]."""


@pytest.mark.parametrize(("way", "degrees"), [(RIGHT, 0), (UP, 90), (RIGHT + UP, 45), (-UP, -90)])
def test_a_direction_is_counted_from_the_right_upwards(way, degrees):
    begin = np.array([0.3, 0.0])
    np.testing.assert_allclose(
        stroke(begin, begin + way), [np.radians(degrees), np.linalg.norm(way)], atol=1e-12
    )


def test_looking_up_a_turn_to_the_side_is_a_smaller_way():
    begin = np.array([0.0, np.radians(60)])
    assert stroke(begin, begin + LEFT) == pytest.approx([np.pi, 0.05])


def test_every_stroke_ends_where_the_next_begins_and_the_last_with_the_motion():
    seen = np.cumsum([0 * UP, RIGHT, RIGHT, UP, LEFT, LEFT, UP], axis=0)
    made = np.degrees(directions(seen, (0, 2, 3), 6))
    np.testing.assert_allclose(made, [0, 90, 180], atol=1e-9)


def test_directions_are_near_within_45_degrees_around_the_circle():
    degrees = [(0, 44), (0, 46), (-170, 150), (170, -170), (90, -90), (np.nan, 0)]
    assert [near(*np.radians(pair)) for pair in degrees] == [True, False, True, True, False, False]
