"""Exchanged states tell the networks written by hand apart; only what differs is judged."""

from collections import Counter
from dataclasses import replace

import jax
import numpy as np
import pytest
from by_hand.role_networks import MOTIONS

from motionese.imitation.roles import exchanged
from motionese.imitation.roles.exchange import Case
from motionese.network import Level, grow

DECIDES = {
    "separate": {"first": "lower", "order": "upper", "transfer": "upper"},
    "all_in_cf": {"first": "lower", "order": "lower", "transfer": "lower"},
    "all_in_cs": {"first": "upper", "order": "upper"},
}
"""Whose stroke follows, by kind."""


def rows_of(lesson, **columns):
    rows = exchanged(lesson)
    return [row for row in rows if all(row[name] == value for name, value in columns.items())]


@pytest.mark.parametrize("name", DECIDES)
def test_the_level_that_decides_is_followed(lesson_of, name):
    rows = exchanged(lesson_of(name))
    for kind, follows in DECIDES[name].items():
        assert {row["follows"] for row in rows if row["kind"] == kind} == {follows}


def test_where_cs_decides_all_a_transferred_order_comes_with_its_side(lesson_of):
    """The second stroke follows the order, though the first one is not where it was to begin."""
    transfers = rows_of(lesson_of("all_in_cs"), kind="transfer")
    assert {row["follows"] for row in transfers} == {"upper"}


def test_only_what_two_motions_differ_in_first_is_judged(lesson_of):
    rows = exchanged(lesson_of("separate", demonstrations=3))

    assert Counter(row["kind"] for row in rows) == {
        "first": 8 * 3,  # each with the two that go to the other side
        "order": 4 * 3,  # each with the one that goes to the same side
        "transfer": 4 * 3,  # each with the one that goes to the other side, and on otherwise
    }
    assert {(row["kind"], row["stroke"]) for row in rows} == {
        ("first", 1),
        ("order", 2),
        ("transfer", 2),
    }
    assert {row["split"] for row in rows} == {"cf"}
    assert {row["demonstration"] for row in rows} == {1, 2, 3}
    (transfer,) = rows_of(
        lesson_of("separate", demonstrations=1), kind="transfer", motion_lower="middle →↑"
    )
    assert transfer == {
        "motion_lower": "middle →↑",
        "motion_upper": "middle ←↓",
        "demonstration": 1,
        "split": "cf",
        "kind": "transfer",
        "stroke": 2,
        "follows": "upper",
    }


def test_an_order_that_is_not_ambiguous_is_not_transferred(lesson_of):
    lesson = lesson_of("separate", motions=[("right", "up"), ("left", "up"), ("left", "down")])
    assert {
        (row["motion_lower"], row["motion_upper"]) for row in rows_of(lesson, kind="transfer")
    } == {("middle →↑", "middle ←↓")}


def test_an_order_is_not_transferred_to_where_only_one_way_leads_on(lesson_of):
    lesson = lesson_of("separate")
    one_way = {p: angle for p, angle in lesson.primitives.items() if p.name != "right up"}
    rows = rows_of(replace(lesson, primitives=one_way), kind="transfer")
    assert {row["motion_lower"] for row in rows} == {"middle ←↑", "middle ←↓"}


def test_strokes_that_go_the_same_way_are_not_judged(lesson_of):
    lesson = lesson_of("separate", motions=[("right", "up"), ("right", "down")])
    up = lesson.demonstrations[0].seen
    alike = tuple(replace(each, seen=up) for each in lesson.demonstrations)
    assert len(exchanged(lesson)) == 4
    assert exchanged(replace(lesson, demonstrations=alike)) == []


def test_every_split_of_a_higher_network_is_tried(lesson_of):
    lesson = lesson_of("all_in_cs")
    network = grow(lesson.network, Level(1, 200.0), key=jax.random.key(0), influence=0.0)
    taller = tuple(
        replace(each, initial_state=np.append(each.initial_state, 1.0))
        for each in lesson.demonstrations
    )
    rows = exchanged(replace(lesson, network=network, demonstrations=taller))
    followed = {
        split: {row["follows"] for row in rows if row["split"] == split} for split in ("cf", "cs")
    }
    assert followed == {"cf": {"upper"}, "cs": {"lower"}}
    assert len(rows) == 2 * len(exchanged(lesson))


def test_a_lesson_of_one_motion_gives_no_rows(lesson_of):
    assert exchanged(lesson_of("separate", motions=MOTIONS[:1])) == []


def test_what_was_not_recognised_is_left_out_and_counted(lesson_of):
    lesson = lesson_of("separate")
    lost, *others = lesson.demonstrations
    nothing = replace(lost, initial_state=np.full_like(lost.initial_state, np.nan))
    lessened = replace(lesson, demonstrations=(nothing, *others))

    assert (lesson.left_out, lessened.left_out) == (0, 1)
    assert exchanged(lessened) == [
        row
        for row in exchanged(lesson)
        if not (
            row["demonstration"] == 1
            and lost.sequence.name in (row["motion_lower"], row["motion_upper"])
        )
    ]


@pytest.mark.parametrize(
    ("direction", "follows"),
    [
        (10, "lower"),
        (-44, "lower"),
        (-46, "neither"),
        (50, "upper"),
        (20, "neither"),
        (180, "neither"),
        (np.nan, "neither"),
    ],
)
def test_a_stroke_follows_the_motion_that_it_alone_is_within_45_degrees_of(
    lesson_of, direction, follows
):
    lower, upper = lesson_of("separate", demonstrations=1).demonstrations[:2]
    case = Case(lower, upper, "first", 0, (np.radians(0.0), np.radians(60.0)))
    assert case.follows(np.radians(direction)) == follows
