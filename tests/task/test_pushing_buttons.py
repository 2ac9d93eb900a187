"""The task's automaton: what it derives agrees with the paper's Table II, and nothing else fits."""

import numpy as np
import pytest

from motionese.errors import TaskError
from motionese.task import PUSHING_BUTTONS, Attempt, PrimitiveSequence


def names(motions):
    return {motion.name for motion in motions}


def test_five_primitives_six_pairs_seven_triples():
    assert names(PUSHING_BUTTONS.sequences(1)) == {"UR ↓", "LR ↑", "UR ←", "UL ↓", "LL ↑"}
    assert len(PUSHING_BUTTONS.sequences(2)) == 6
    assert len(PUSHING_BUTTONS.sequences(3)) == 7


def test_four_pairs_are_taught():
    taught = names(PUSHING_BUTTONS.lesson("taught pairs"))
    assert len(taught) == 4
    assert names(PUSHING_BUTTONS.sequences(2)) - taught == {"LR ↑↓", "LL ↑↓"}


def test_lessons_that_branch_teach_further_pairs():
    lesson = {name: names(PUSHING_BUTTONS.lesson(name)) for name in PUSHING_BUTTONS.lessons}
    assert lesson["branching"] - lesson["taught pairs"] == {"LR ↑↓"}
    assert lesson["all pairs"] == names(PUSHING_BUTTONS.sequences(2))
    triples = lesson["pairs and triples"] & names(PUSHING_BUTTONS.sequences(3))
    assert triples == {"UR ↓↑←", "UR ↓↑↓"}


def test_three_triples_are_made_of_taught_pairs_and_four_are_not():
    triples = PUSHING_BUTTONS.sequences(3)
    trained = {m.name for m in triples if PUSHING_BUTTONS.is_taught(m)}
    assert trained == {"UR ↓↑←", "LR ↑←↓", "UR ←↓↑"}
    assert names(triples) - trained == {"UR ↓↑↓", "LR ↑↓↑", "UL ↓↑↓", "LL ↑↓↑"}


def test_every_sequence_runs_on_from_where_it_was():
    for length in (1, 2, 3, 4):
        for motion in PUSHING_BUTTONS.sequences(length):
            assert len(motion.places) == length + 1
            assert all(a.end == b.start for a, b in motion.pairs())


@pytest.mark.parametrize("length", [1, 2, 3])
def test_a_motion_is_read_from_its_name_and_from_its_primitives(length):
    for motion in PUSHING_BUTTONS.sequences(length):
        assert PUSHING_BUTTONS.sequence(motion.name) == motion
        assert PUSHING_BUTTONS.sequence("+".join(p.name for p in motion.primitives)) == motion


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("UR ↑", "impossible sequence 'UR ↑': from UR only ↓, ←"),
        ("UR ↓←", "from LR only ↑"),
        ("PUSH(R)+SLIDE", "PUSH(R) ends at LR, SLIDE starts at UR"),
        ("PUSH(X)+SLIDE", "unknown primitive 'PUSH(X)'; did you mean 'PUSH("),
        ("XX ↓", "is no lesson or sequence"),
        ("UR", "is no lesson or sequence"),
        ("", "is no lesson or sequence"),
    ],
)
def test_impossible_motions_are_told(text, told):
    with pytest.raises(TaskError) as error:
        PUSHING_BUTTONS.sequence(text)
    assert told in str(error.value)


def test_a_motion_needs_a_primitive():
    with pytest.raises(TaskError, match="at least one primitive"):
        PrimitiveSequence(())


def test_a_lesson_is_named_or_listed():
    lesson = PUSHING_BUTTONS.lesson
    assert lesson("primitives") == PUSHING_BUTTONS.sequences(1)
    assert [m.name for m in lesson(["UR ↓", "UR ↓", "PUSH(L)"])] == ["UR ↓", "UL ↓"]
    assert [m.name for m in lesson("UR ↓↑")] == ["UR ↓↑"]
    assert set(lesson("triples")) == set(PUSHING_BUTTONS.sequences(3))
    with pytest.raises(TaskError, match="impossible sequence"):
        lesson(["UR ↓↓"])


def test_a_sequence_is_found_by_its_places_and_put_in_words():
    pair = PUSHING_BUTTONS.sequence("UR ↓↑")
    assert PUSHING_BUTTONS.through(pair.places) == pair
    assert PUSHING_BUTTONS.through(["UR", "LL"]) is None
    assert PUSHING_BUTTONS.through(["UR"]) is None
    assert PUSHING_BUTTONS.in_words(pair) == "from UR down, then up"


@pytest.mark.parametrize(
    ("name", "row", "button", "reached"),
    [
        ("UR ↓", 12, 0, [9.0]),
        ("UR ↓", 12, 1, [0.0]),
        ("UR ↓", 3, 0, [0.0]),
        ("UR ↓↑", 16, 0, [9.0]),
        ("UR ←↓", 26, 1, [9.0]),
        ("LR ↑↓↑", 0, 0, [0.0]),
        ("LR ↑↓↑", 27, 0, [9.0]),
        ("UR ↓↑↓", 13, 0, [9.0, 0.0]),
        ("UR ↓↑↓", 41, 0, [0.0, 9.0]),
        ("LR ↑", 5, 0, []),
    ],
)
def test_a_press_counts_for_the_stroke_that_should_make_it(name, row, button, reached):
    begins = tuple(14 * i for i in range(len(name) - 3))
    row_of = achieved(name, begins, 14 * len(begins), row, button)
    assert row_of["press_depths_mm"] == " ".join(f"{depth:.2f}" for depth in reached)
    assert row_of["buttons_due"] == len(reached)
    assert row_of["buttons_pressed"] == sum(depth > 0 for depth in reached)


def test_a_touch_is_no_press():
    assert achieved("UR ↓", (0,), 14, 12, 0, depth=4.9)["buttons_pressed"] == 0
    assert achieved("UR ↓", (0,), 14, 12, 0, depth=5.1)["buttons_pressed"] == 1


def achieved(name, begins, rows, row, button, depth=9.0):
    depths = {effect: np.zeros(rows) for effect in PUSHING_BUTTONS.effects}
    depths[PUSHING_BUTTONS.effects[button]][row] = depth
    path = np.zeros((rows, 3))
    sequence = PUSHING_BUTTONS.sequence(name)
    return PUSHING_BUTTONS.achieved(sequence, Attempt(begins, path, path, depths))
