"""Readings against all possible ones, sequences put together from elements, networks by hand."""

from dataclasses import replace

import numpy as np
import pytest
from by_hand.role_networks import BEGINS, CROSSING, FIRST, MOTIONS, ROWS, sequence_of
from by_hand.symbols import distance, readings
from hypothesis import given
from hypothesis import strategies as st

from motionese.imitation.roles import RecognisedDemonstration
from motionese.imitation.roles import readings as readings_of
from motionese.imitation.roles.symbols import (
    ReadOut,
    edit_distance,
    read_out,
    symbols_read,
)
from motionese.learning import activity
from motionese.unit_interval import logit

seeds = st.integers(0, 2**32 - 1)
symbols = st.lists(st.sampled_from("ABC"), max_size=4)


def elements(rng, lengths, units=2):
    return [(name, rng.uniform(size=(n, units))) for name, n in zip("ABC", lengths, strict=False)]


@given(seeds, st.lists(st.integers(1, 4), min_size=1, max_size=3), st.integers(1, 7))
def test_of_all_readings_the_nearest_is_found(seed, lengths, rows):
    rng = np.random.default_rng(seed)
    signatures = elements(rng, lengths)
    shown = rng.uniform(size=(rows, 2))

    possible = [found[1:] for found in sorted(readings(shown, signatures))]

    read = read_out(shown, signatures)
    assert (read.symbols, read.boundaries) == (possible[0] if possible else ((), ()))


@given(seeds, st.lists(st.sampled_from("ABC"), min_size=1, max_size=6))
def test_what_is_put_together_from_elements_is_read_as_these(seed, names):
    rng = np.random.default_rng(seed)
    own = dict(elements(rng, (4, 6, 9), units=12))
    for slower in (1, 2):
        parts = [np.repeat(own[name], slower, axis=0) for name in names]
        shown = np.concatenate(parts) + 0.01 * rng.normal(size=(sum(map(len, parts)), 12))
        read = read_out(shown, list(own.items()))
        begins = np.cumsum([0, *(len(part) for part in parts)])[:-1]
        assert read.symbols == tuple(names)
        assert read.boundaries == tuple(begins[1:])


def test_an_element_may_have_several_signatures():
    one, other, third = np.zeros((3, 1)), np.full((3, 1), 0.9), np.full((3, 1), 0.4)
    shown = np.concatenate([other, third, one])
    read = read_out(shown, [("A", one), ("A", other), ("B", third)])
    assert read == ReadOut(("A", "B", "A"), (3, 6))


def test_what_is_too_short_for_any_element_is_read_as_nothing():
    signatures = [("A", np.zeros((8, 1))), ("B", np.ones((9, 1)))]
    assert read_out(np.zeros((4, 1)), signatures) == ReadOut((), ())
    assert read_out(np.ones((5, 1)), signatures) == ReadOut(("B",), ())


@given(symbols, symbols)
def test_the_edit_distance_is_the_fewest_changes(one, other):
    assert edit_distance(one, other) == distance(one, other)


def test_edit_distances_that_are_known():
    assert edit_distance("kitten", "sitting") == 3
    assert edit_distance("", "AB") == edit_distance("AB", "") == 2


def test_the_error_of_boundaries_is_that_of_the_worst():
    read = ReadOut(("A", "B", "A"), (13, 30))
    assert read.boundary_error((0, 14, 28)) == 2
    assert np.isnan(read.boundary_error((0, 14)))
    assert np.isnan(ReadOut(("A",), ()).boundary_error((0,)))


def alone_of(lesson):
    """The primitives by themselves: a motion up to its second stroke, and from there on."""
    shown = []
    for each in lesson.demonstrations:
        inside = activity(lesson.network, each.initial_state, ROWS, first=FIRST)
        middle = logit(inside[BEGINS[1]].astype(float))
        here = lesson.network.channels.from_unit(inside[BEGINS[1], :2])
        states, firsts = (each.initial_state, middle), (each.first, here)
        for primitive, state, first in zip(each.sequence.primitives, states, firsts, strict=True):
            sequence = CROSSING.sequence(primitive.name)
            seen = np.zeros((BEGINS[1], 2))
            shown.append(RecognisedDemonstration(sequence, each.number, state, first, (0,), seen))
    return replace(lesson, demonstrations=tuple(shown))


@pytest.mark.parametrize("name", ["separate", "all_in_cf", "all_in_cs"])
def test_motions_that_go_through_their_primitives_are_read_as_these(lesson_of, name):
    lesson = lesson_of(name)
    rows = symbols_read(readings_of(lesson, alone_of(lesson), lesson))

    assert [(row["level"], row["reference"]) for row in rows[:: len(MOTIONS) * 2]] == [
        (level, reference) for level in ("io", "cf", "cs") for reference in ("alone", "taught")
    ]
    for row in rows:
        if row["level"] == "cf":
            assert (row["edit_distance"], row["boundary_error_steps"]) == (0, 0)
    assert rows[0] == {
        "level": "io",
        "reference": "alone",
        "motion": sequence_of(MOTIONS[0]).name,
        "demonstration": 1,
        "read": "→↑",
        "true": "→↑",
        "edit_distance": 0,
        "boundary_error_steps": 0,
    }


def test_a_motion_is_read_by_other_demonstrations_than_itself(lesson_of):
    """A lesson of a single demonstration leaves only other motions to read it by."""
    lesson = lesson_of("separate", motions=MOTIONS[:2], demonstrations=1)
    none = replace(lesson, demonstrations=())
    rows = [r for r in symbols_read(readings_of(lesson, none, lesson)) if r["level"] == "cf"]
    assert [row["reference"] for row in rows] == ["taught"] * 2
    assert all(row["edit_distance"] > 0 for row in rows)


def test_a_level_at_rest_is_not_read(lesson_of):
    lesson = lesson_of("all_in_cf", scatter=0.0)
    assert {row["level"] for row in symbols_read(readings_of(lesson, lesson, lesson))} == {
        "io",
        "cf",
    }
