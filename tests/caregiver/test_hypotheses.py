"""What a hand shows: the ways that are known, and something else."""

import numpy as np
import pytest
from hands import no_motions, straying

from motionese.caregiver import SOMETHING_ELSE, evenly_along, hypotheses, intended_way, lasting
from motionese.caregiver.hypotheses import INDEPENDENT, SPREAD_CM
from motionese.task import PUSHING_BUTTONS, SHAPES

HANDS = 400


def likeliest(path, **how):
    return next(iter(hypotheses(path, PUSHING_BUTTONS, **how)))


def way_of(name, task=PUSHING_BUTTONS):
    return intended_way(task.sequence(name), task)


@pytest.mark.slow
def test_strokes_of_hands_that_stray_by_2_cm_are_seen_rightly():
    rng = np.random.default_rng(7)
    known = [s for length in (1, 2, 3, 4) for s in PUSHING_BUTTONS.sequences(length)]
    shown = [known[i] for i in rng.integers(len(known), size=HANDS)]
    right = [
        likeliest(straying(intended_way(s, PUSHING_BUTTONS), rng, 2.0)) == s.name for s in shown
    ]
    assert np.mean(right) >= 0.95


def test_shapes_that_are_no_motion_are_something_else():
    rng = np.random.default_rng(8)
    for name, shapes in no_motions(PUSHING_BUTTONS, rng, HANDS // 6).items():
        seen = [likeliest(straying(shape, rng, 1.0)) for shape in shapes]
        assert seen.count(SOMETHING_ELSE) >= 0.95 * len(seen), (name, seen)


def test_the_shares_are_those_of_the_densities_that_are_described():
    path = straying(way_of("UR ↓"), np.random.default_rng(0), 5.0)
    shares = hypotheses(path, PUSHING_BUTTONS)
    assert sum(shares.values()) == pytest.approx(1)
    assert list(shares.values()) == sorted(shares.values(), reverse=True)
    off = 100 * (evenly_along(path) - way_of("UR ↓"))
    squared, spread = (off**2).sum(1).mean(), SPREAD_CM**2
    strokes = [way_of(s.name) for s in PUSHING_BUTTONS.sequences(1)]
    wide = 100 * np.mean([np.linalg.norm(way[-1] - way[0]) for way in strokes])
    ratio = (np.exp(-squared / 2 / spread) / (2 * np.pi * spread)) / (1 / wide**2)
    expected = ratio**INDEPENDENT
    assert shares["UR ↓"] / shares[SOMETHING_ELSE] == pytest.approx(expected, rel=1e-6)


def test_a_motion_of_one_s_own_is_known_by_the_way_it_was_shown():
    ends = np.stack([PUSHING_BUTTONS.position(name) for name in ("UR", "LL")])
    diagonal = lasting(ends, 20)
    assert likeliest(diagonal) == SOMETHING_ELSE
    own = {"wave": diagonal}
    again = straying(diagonal, np.random.default_rng(1), 1.0)
    assert likeliest(again, own=own) == "wave"
    assert likeliest(again[::-1], own=own) == SOMETHING_ELSE
    assert likeliest(way_of("UR ↓"), own=own) == "UR ↓"


@pytest.mark.parametrize("task", [PUSHING_BUTTONS, SHAPES], ids=lambda task: task.name)
def test_while_the_hand_moves_it_is_compared_with_as_much_of_every_way(task):
    for sequence in task.sequences(2):
        way = intended_way(sequence, task, 80)
        for rows in (30, 50, 70, 80):
            shares = hypotheses(way[:rows], task, whole=False)
            best = max(shares.values())
            names = [name for name, share in shares.items() if share > 0.9 * best]
            assert any(sequence.name.startswith(name) for name in names), (rows, names)
    half = intended_way(task.sequences(1)[0], task, 80)[:40]
    assert hypotheses(half, task, whole=False)[task.sequences(1)[0].name] > 0.2


def test_half_a_stroke_is_no_stroke_once_it_has_ended():
    half = intended_way(PUSHING_BUTTONS.sequence("UR ↓"), PUSHING_BUTTONS, 80)[:40]
    assert likeliest(half) == SOMETHING_ELSE
    assert likeliest(half, whole=False) == "UR ↓"
