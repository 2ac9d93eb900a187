"""A motion is divided where the seen hand pauses; who agrees on a boundary is counted."""

from itertools import permutations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from motionese.experiment import read_settings
from motionese.imitation import Scene
from motionese.imitation.repertoire import Element, element_to_a_pause
from motionese.imitation.segments import Agreement, agreement, strokes_seen
from motionese.minimum_jerk import minimum_jerk

rising = st.lists(st.integers(0, 40), max_size=5, unique=True).map(sorted)


def hand(*pieces):
    """A hand that goes these ways, 12 rows each, and rests so many rows after each."""
    path = [np.zeros((1, 2))]
    for way, rest in pieces:
        done = minimum_jerk(np.minimum(np.arange(1, 13 + rest) / 12, 1.0))[:, None]
        path.append(path[-1][-1] + done * np.array(way))
    return np.concatenate(path)


def test_strokes_begin_where_pauses_end():
    path = hand(((0.0, -0.4), 8), ((0.3, 0.0), 4), ((0.0, 0.4), 2))
    strokes = strokes_seen(path, 10.0)
    assert len(strokes) == 3
    for (start, end), begins in zip(strokes, (0, 20, 36), strict=True):
        assert abs(start - begins) <= 1 and abs(end - begins - 12) <= 2


def test_a_hand_at_rest_or_seen_too_briefly_makes_no_strokes():
    assert strokes_seen(np.zeros((30, 2)), 10.0) == ()
    assert strokes_seen(np.zeros((3, 2)), 10.0) == ()


@given(rising, rising, st.integers(0, 3))
def test_as_many_boundaries_agree_as_can_be_paired(found, true, within):
    most = (
        max(
            sum(abs(a - b) <= within for a, b in zip(found, order, strict=False))
            for order in permutations([*true, *[10**6] * len(found)], len(found))
        )
        if len(found) + len(true) <= 6
        else None
    )
    counted = agreement(found, true, within)
    assert counted[1:] == (len(found), len(true))
    assert most is None or counted.both == most
    assert agreement(true, found, within).both == counted.both


def test_what_is_found_twice_counts_once():
    assert agreement([13, 14, 30], [14], 2) == Agreement(both=1, found=3, true=1)


def elements():
    ways = {"UR ↓": (0.0, -0.4), "UR ←": (0.4, 0.0)}
    known = [Element("cf", name, hand((way, 2)), np.zeros(2)) for name, way in ways.items()]
    pair = hand(((0.0, -0.4), 6), ((0.0, 0.4), 2))
    return [*known, Element("cf", "UR ↓↑", pair, np.zeros(2))]


def nearest(shown, known):
    return element_to_a_pause(known, shown, np.ones(2), lambda v: strokes_seen(v, 10.0))


def test_the_first_stroke_up_to_a_pause_tells_the_element_however_long_it_lasts():
    single = elements()[:2]
    for rest in (4, 12):
        assert nearest(hand(((0.0, -0.4), rest), ((0.0, 0.4), 2)), single) == "UR ↓"
        assert nearest(hand(((0.4, 0.0), rest), ((0.0, -0.4), 2)), single) == "UR ←"
    slow = np.repeat(hand(((0.4, 0.0), 4), ((0.0, -0.4), 2)), 2, axis=0)
    assert nearest(slow, single) == "UR ←"


def test_an_element_of_two_strokes_is_compared_with_two():
    _, aside, pair = elements()
    assert nearest(hand(((0.0, -0.4), 8), ((0.0, 0.4), 2)), [aside, pair]) == "UR ↓↑"
    assert nearest(hand(((0.0, -0.4), 8), ((0.4, 0.0), 2)), elements()) == "UR ↓"
    assert nearest(hand(((0.4, 0.0), 2)), [aside, pair]) == "UR ←"


def test_a_shown_pair_is_put_to_its_first_primitive_by_the_robot_s_own_eye():
    chosen = read_settings("order", ["caregiver.motionese.pauses.strength=0.5"])
    scene = Scene(chosen, seed=4)
    bearing, scale = scene.body.bearing, scene.body.channels.interval_widths
    known = [
        Element("cf", s.name, scene.show(s, "own").sensed, np.zeros(2))
        for s in scene.task.sequences(1)
    ]
    for sequence in scene.task.lesson("branching"):
        seen = scene.seen(scene.show(sequence, "pair", manner=chosen.caregiver))
        found = element_to_a_pause(known, seen, scale, lambda v: strokes_seen(bearing(v), 10.0))
        assert sequence.name.startswith(found), (sequence.name, found)
