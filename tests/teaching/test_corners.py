"""Which corners the pauses of a drawing tell, and what the robot wishes where they do not."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as some

from motionese.caregiver import lasting
from motionese.kinematics import measure
from motionese.minimum_jerk import minimum_jerk
from motionese.task import PUSHING_BUTTONS
from motionese.teaching.corners import Corner, corners_of, pauses_in_words, wish_in_words

RATE_HZ = 10.0
MANY = [s.name for count in (2, 3, 4) for s in PUSHING_BUTTONS.sequences(count)]
CLEAR_S = 0.5
"""A pause that a person means as one."""

motions, seeds = some.sampled_from(MANY), some.integers(0, 10**6)


def corners(name, path):
    pauses = measure(path, RATE_HZ).pauses
    return corners_of(PUSHING_BUTTONS.sequence(name), path, pauses, RATE_HZ, PUSHING_BUTTONS)


def resting(*stops):
    """A hand's path through stops (place or position, rest [s]), a stroke of 1 s between two."""
    at = [np.array(PUSHING_BUTTONS.position(p) if isinstance(p, str) else p) for p, _ in stops]
    rows = [at[0][None]]
    for start, end, (_, rest) in zip(at, at[1:], stops[1:], strict=False):
        share = minimum_jerk(np.arange(1, 11) / 10)[:, None]
        rows += [start + share * (end - start), np.repeat(end[None], round(rest * RATE_HZ), axis=0)]
    return np.concatenate(rows)


@settings(max_examples=60, deadline=None)
@given(motions, some.floats(0.4, 2.5), some.floats(CLEAR_S, 1.5), seeds)
def test_who_pauses_clearly_at_every_corner_is_never_asked_to(
    draw_in_time, name, stroke_s, rest_s, seed
):
    path = draw_in_time(name, seconds=stroke_s, seed=seed, rests=(rest_s, rest_s + 0.01))
    told = corners(name, path)
    assert [c.place for c in told] == list(PUSHING_BUTTONS.sequence(name).places[1:-1])
    assert all(c.told for c in told) and not wish_in_words(told)
    assert pauses_in_words(told).startswith("I saw you pause at")


@settings(max_examples=30, deadline=None)
@given(motions, some.floats(0.4, 1.5), seeds)
def test_who_never_pauses_is_asked_to_at_every_corner(draw_in_time, name, stroke_s, seed):
    told = corners(name, draw_in_time(name, seconds=stroke_s, seed=seed, rests=(0.0, 0.01)))
    assert told and not any(c.told for c in told)
    wish = wish_in_words(told)
    assert wish.startswith("Pause at the corner") and all(c.place in wish for c in told)
    assert not pauses_in_words(told)


def test_a_single_stroke_has_no_corner():
    told = corners("UR ↓", resting(("UR", 0), ("LR", 1.0)))
    assert told == () and not wish_in_words(told) and not pauses_in_words(told)


def test_a_pause_tells_the_corner_that_it_is_near_and_no_other():
    ur, ul = (np.array(PUSHING_BUTTONS.position(name)) for name in ("UR", "UL"))
    middle, shortly_before = (ur + ul) / 2, ur + 0.8 * (ul - ur)
    on_the_way = resting(("UR", 0), (middle, 1.0), ("UL", 0), ("LL", 0))
    assert corners("UR ←↓", on_the_way) == (Corner("UL", told=False),)
    nearly = resting(("UR", 0), (shortly_before, 1.0), ("UL", 0), ("LL", 0))
    assert corners("UR ←↓", nearly) == (Corner("UL", told=True),)
    once = resting(("UR", 0), ("LR", 1.0), ("UR", 0), ("LR", 0), ("UR", 0))
    assert [c.told for c in corners("UR ↓↑↓↑", once)] == [True, False, False]
    again = resting(("UR", 0), ("LR", 0), ("UR", 0), ("LR", 1.0), ("UR", 0))
    assert [c.told for c in corners("UR ↓↑↓↑", again)] == [False, False, True]


def test_an_even_pace_and_too_few_rows_tell_nothing():
    even = lasting(resting(("UR", 0), ("UL", 0), ("LL", 0))[[0, 10, -1]], 30)
    assert corners("UR ←↓", even) == corners("UR ←↓", even[::10]) == (Corner("UL", told=False),)


def test_corners_are_asked_for_once_each_and_only_where_a_pause_is_missing():
    told, not_told = Corner("UL", told=True), Corner("LL", told=False)
    assert wish_in_words([told, not_told]) == (
        "Pause at the corner LL, please: I could not tell one stroke from the next."
    )
    assert not pauses_in_words([told, not_told])
    assert "the corner LL, please" in wish_in_words([not_told, told, not_told])
    assert "the corners LL and UR, please" in wish_in_words([not_told, Corner("UR", told=False)])
    assert pauses_in_words([told, told]) == "I saw you pause at UL."
