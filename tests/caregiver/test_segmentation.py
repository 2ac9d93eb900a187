"""Paths are read as sequences of a task, and divided where primitives begin."""

from itertools import combinations

import numpy as np
import pytest

from motionese.caregiver import (
    evenly_along,
    intended_way,
    lasting,
    moving,
    rows_of_places,
    segmented,
    sequence_in,
    stroke_length,
)
from motionese.task import PUSHING_BUTTONS, SHAPES

every_task = pytest.mark.parametrize("task", [PUSHING_BUTTONS, SHAPES], ids=lambda t: t.name)


def trembling(way, rows, seed=0, size_m=0.01):
    """A hand that goes a way unevenly, and is off it by about a cm."""
    rng = np.random.default_rng(seed)
    at = np.linspace(0, 1, rows) ** rng.uniform(0.7, 1.4)
    path = np.stack([np.interp(at, np.linspace(0, 1, len(way)), c) for c in way.T], axis=-1)
    off = np.cumsum(rng.normal(size=path.shape), axis=0)
    return path + size_m * off / np.abs(off).max()


@every_task
@pytest.mark.parametrize("length", [1, 2, 3])
def test_a_trembling_hand_is_read_as_what_it_shows(task, length):
    for seed, sequence in enumerate(task.sequences(length)):
        path = trembling(intended_way(sequence, task), 20 * length, seed)
        assert sequence_in(path, task) == sequence


@every_task
def test_what_the_task_does_not_allow_is_no_sequence(task):
    ends = {frozenset((p.start, p.end)) for p in task.primitives}
    for pair in combinations(task.places, 2):
        if frozenset(pair) not in ends:
            way = lasting(np.stack([task.position(name) for name in pair]), 20)
            assert sequence_in(way, task) is None
    still = np.repeat(task.position("UR")[None], 10, axis=0)
    assert sequence_in(still, task) is None


@every_task
def test_a_path_is_divided_where_its_primitives_begin(task):
    for sequence in task.sequences(3):
        strokes = [
            lasting(p.way(np.linspace(0, 1, 40), task.position(p.start), task.position(p.end)), 16)
            for p in sequence.primitives
        ]
        demonstration = segmented(np.concatenate(strokes), sequence, task)
        assert demonstration.begins == pytest.approx((0, 16, 32), abs=1)
    path = np.concatenate(strokes)
    assert segmented(path, None, task).begins == (0,)


def test_places_are_passed_in_the_order_given_where_the_path_is_nearest():
    path = np.zeros((9, 3))
    path[:, 0] = [0, 1, 2, 3, 4, 3, 2, 1, 0]
    places = np.zeros((3, 3))
    places[:, 0] = [0, 4, 1]
    assert rows_of_places(path, places) == (0, 4, 7)
    assert rows_of_places(path, places[[0, 2, 1, 2]]) == (0, 1, 4, 7)
    rng = np.random.default_rng(0)
    path, places = rng.normal(size=(12, 3)), rng.normal(size=(4, 3))
    apart = np.linalg.norm(path[None] - places[:, None], axis=-1)
    every = [(0, *rows) for rows in combinations(range(1, 12), 3)]
    best = min(every, key=lambda rows: sum(apart[i, row] for i, row in enumerate(rows)))
    assert rows_of_places(path, places) == best, "the least sum of distances, by all of them"


def test_a_way_is_followed_evenly_whatever_its_timing():
    corner = np.array([[0.0, 0, 0], [0.3, 0, 0], [0.3, 0.1, 0]])
    slow_then_fast = np.concatenate([lasting(corner[:2], 50), lasting(corner[1:], 4)])
    for path in (corner, slow_then_fast):
        even = evenly_along(path, 5)
        np.testing.assert_allclose(
            even, [[0, 0, 0], [0.1, 0, 0], [0.2, 0, 0], [0.3, 0, 0], [0.3, 0.1, 0]], atol=1e-12
        )


def test_a_stroke_is_as_long_as_the_task_s_on_the_average():
    assert 0.22 < stroke_length(PUSHING_BUTTONS) < 0.24
    arc = intended_way(SHAPES.sequence("T ◝"), SHAPES, 1000)
    chord = np.linalg.norm(SHAPES.position("LR") - SHAPES.position("T"))
    assert np.linalg.norm(np.diff(arc, axis=0), axis=1).sum() > 1.15 * chord


def test_stillness_is_cut_to_what_the_caregiver_rests():
    there, here = np.array([0.0, 0.0, 0.1]), np.zeros(3)
    way = lasting(np.stack([here, there]), 5)
    path = np.concatenate([[here] * 9, way, [there] * 9, way[::-1], [here] * 9])
    cut = moving(path, rest_steps=2)
    assert len(cut) == 1 + 4 + 2 + 4, "one row at the ends, two in the middle"
    np.testing.assert_array_equal(cut[[0, -1]], [here, here])
