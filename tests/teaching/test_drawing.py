"""A drawing becomes a demonstration at the robot's tempo, and bad ones are told kindly."""

import numpy as np
import pytest
from drawn import points_of, view
from hypothesis import given
from hypothesis import strategies as some

from motionese.caregiver import lasting, sequence_in
from motionese.task import PUSHING_BUTTONS
from motionese.teaching.drawing import LONGEST_S, MOST_POINTS, Drawing, DrawingError, at_tempo

UR, LR, LL = (PUSHING_BUTTONS.position(name) for name in ("UR", "LR", "LL"))


@pytest.mark.parametrize("seconds", [0.5, 1.4, 4.0])
@pytest.mark.parametrize(("name", "strokes"), [("UR ↓", 1), ("UR ←↓", 2), ("LL ↑↓↑", 3)])
def test_slow_and_fast_hands_show_at_the_same_tempo(draw, scene, seconds, name, strokes):
    rows = strokes * scene.settings.caregiver.primitive_rows
    assert len(draw(name, seconds=seconds)) == pytest.approx(rows, rel=0.1)


def test_a_demonstration_begins_and_ends_where_the_pen_did(draw):
    path = draw("UR ←↓")
    assert np.linalg.norm(path[0] - UR) < 0.01
    assert np.linalg.norm(path[-1] - LL) < 0.01


def test_slips_and_endless_scribbles_are_refused_in_words(scene):
    manner = scene.settings.caregiver
    still = np.zeros((20, 3)) + UR
    with pytest.raises(DrawingError, match="very short"):
        at_tempo(still, scene.task, manner)
    scribble = np.concatenate([np.stack([UR, LR])] * 4)
    with pytest.raises(DrawingError, match="longer than 6 strokes"):
        at_tempo(lasting(scribble, 100), scene.task, manner)


def test_no_more_points_than_allowed_are_taken():
    drawing = Drawing()
    drawing.add([(0.1 * row, 0.5, 0.5) for row in range(MOST_POINTS + 100)])
    assert len(drawing) == MOST_POINTS and drawing.full


def test_a_point_at_the_end_of_time_costs_no_memory():
    drawing = Drawing()
    drawing.add([(0.0, 0.1, 0.1), (100.0, 0.2, 0.2), (1e12, 0.3, 0.3), (200.0, 0.4, 0.4)])
    assert drawing.full and drawing.seconds == 0.1
    assert len(drawing.sampled(10.0)) < 20


@given(
    some.lists(
        some.tuples(some.floats(0, 3e4), some.floats(-1, 2), some.floats(-1, 2)),
        min_size=1,
        max_size=50,
    )
)
def test_whatever_is_drawn_is_sampled_or_refused(points):
    drawing = Drawing()
    drawing.add(sorted(points))
    sampled = drawing.sampled(10.0)
    assert np.isfinite(sampled).all() and len(sampled) <= 10 * LONGEST_S + 2
    assert sampled.min() >= -1 and sampled.max() <= 2


def test_rows_follow_the_pen():
    drawing = Drawing()
    drawing.add(points_of("UR ↓", seconds=2.0))
    sampled = drawing.sampled(10.0)
    assert np.diff(sampled[:, 1]).min() > -0.01, "downwards all the way"


@pytest.mark.parametrize(("name", "milliseconds"), [("UR ↓", 60), ("UR ↓↑", 120), ("UR ←↓", 240)])
def test_a_flick_is_seen_to_its_end(scene, name, milliseconds):
    points = points_of(name)
    share = milliseconds / points[-1][0]
    drawing = Drawing()
    drawing.add([(share * t, x, y) for t, x, y in points])
    positions, _ = view().positions(drawing.sampled(scene.body.rate_hz))
    path = at_tempo(positions, scene.task, scene.settings.caregiver)
    shown = scene.task.sequence(name)
    assert sequence_in(path, scene.task) == shown
    assert np.linalg.norm(path[-1] - scene.task.position(shown.places[-1])) < 0.02
