"""Recognised motions as the network generates them, one by one as in a batch."""

from dataclasses import replace

import numpy as np
from by_hand.network import rollout, sigmoid
from by_hand.role_networks import BEGINS, ROWS, bearing

from motionese.imitation.roles.generated import generated
from motionese.learning import generate


def test_each_is_what_the_network_makes_of_the_recognised_state(lesson_of):
    lesson = lesson_of("separate")
    network = lesson.network
    shorter = replace(lesson.demonstrations[1], seen=lesson.demonstrations[1].seen[:20])
    shown = (lesson.demonstrations[0], shorter)
    for each, made in zip(shown, generated(replace(lesson, demonstrations=shown)), strict=True):
        rows = len(each.seen)
        assert (made.sequence, made.number, made.begins) == (each.sequence, each.number, BEGINS)
        parts = [
            np.asarray(a, float).tolist() for a in (network.weights, network.bias, network.tau)
        ]
        closed = np.zeros((rows, 2))
        twin = rollout(*parts, network.sizes, each.initial_state, closed, closed)
        np.testing.assert_allclose(made.activity, np.vectorize(sigmoid)(twin), atol=1e-3)
        path = generate(network, each.initial_state, rows, first=each.first)
        np.testing.assert_allclose(made.seen, bearing(path), atol=1e-6)


def test_what_was_not_recognised_is_left_out(lesson_of):
    lesson = lesson_of("separate", demonstrations=1)
    lost = replace(lesson.demonstrations[0], initial_state=np.full(9, np.nan))
    lesson = replace(lesson, demonstrations=(lost, *lesson.demonstrations[1:]))
    assert [m.sequence for m in generated(lesson)] == list(lesson.sequences[1:])
    assert generated(replace(lesson, demonstrations=(lost,))) == []


def test_primitives_by_row_and_by_stroke(lesson_of):
    motion = generated(lesson_of("separate", demonstrations=1))[0]
    assert motion.signs == ["→"] * BEGINS[1] + ["↑"] * (ROWS - BEGINS[1])
    units = slice(2, 7)
    (one, first), (other, second) = motion.strokes(units)
    assert (one, other) == tuple(p.name for p in motion.sequence.primitives)
    np.testing.assert_array_equal(np.concatenate([first, second]), motion.activity[:, units])
    assert len(first) == BEGINS[1]
