"""What the caregiver shows next: by the learner's errors, by its progress, or by chance."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.imitation import Choosing, LoopDone, Mastered
from motionese.task import PUSHING_BUTTONS

LESSON = PUSHING_BUTTONS.sequences(1)
A, B, C, D, E = (sequence.name for sequence in LESSON)


def chosen(by, *loops, shown=2, seed=0):
    done = [LoopDone(0, errors, 2) for errors in loops]
    choosing = Choosing(by=by, shown=shown, mastered=Mastered(loops=1, below_cm=2.0))
    return [s.name for s in choosing.chosen(LESSON, done, np.random.default_rng(seed))]


def test_the_whole_lesson_is_shown_where_nothing_is_chosen():
    assert Choosing().chosen(LESSON, [], np.random.default_rng(0)) == LESSON


@pytest.mark.parametrize("by", ["easiest", "progress"])
def test_what_was_never_shown_is_shown_first_in_the_lesson_s_order(by):
    assert chosen(by) == [A, B]
    assert chosen(by, {A: 9.0, B: 1.0}) == [C, D]


def test_the_easiest_is_what_is_nearest_to_being_mastered():
    assert chosen("easiest", {A: 9.0, B: 3.0, C: 1.0, D: 4.0, E: 1.0}) == [B, D]


def test_what_is_mastered_comes_back_when_nothing_else_is_left_longest_ago_first():
    all_but_a = {B: 1.0, C: 1.0, D: 1.0, E: 1.0}
    assert chosen("easiest", {A: 9.0, **all_but_a}, {B: 1.0, D: 1.0}) == [A, C]


def test_by_progress_that_is_shown_which_changes_most():
    loops = {A: 9.0, B: 9.0, C: 9.0, D: 9.0, E: 9.0}, {A: 8.9, B: 4.0, C: 9.0, D: 12.0, E: 7.0}
    assert chosen("progress", *loops) == [B, D], "worse is no less of a change than better"


def test_a_random_choice_depends_on_its_generator_alone():
    choices = {tuple(chosen("random", seed=seed)) for seed in range(40)}
    assert chosen("random", seed=3) == chosen("random", {A: 9.0, B: 1.0}, seed=3)
    assert len(choices) == 10, "every pair of five is chosen at some time"


@given(
    st.sampled_from(["easiest", "progress", "random"]),
    st.integers(1, 5),
    st.lists(st.dictionaries(st.sampled_from([A, B, C, D, E]), st.floats(0, 30)), max_size=6),
)
def test_so_many_different_motions_of_the_lesson_are_chosen(by, shown, loops):
    names = chosen(by, *loops, shown=shown)
    assert len(names) == shown and names == [n for n in (A, B, C, D, E) if n in names]
