"""The task's automaton: what it derives agrees with the paper's Table II, and nothing else fits."""

import pytest

from motionese.caregiver import PUSHING_BUTTONS, Curriculum, Motion
from motionese.errors import TaskError


def names(motions):
    return {motion.name for motion in motions}


def test_five_primitives_six_pairs_seven_triples():
    assert names(PUSHING_BUTTONS.sequences(1)) == {"UR ↓", "LR ↑", "UR ←", "UL ↓", "LL ↑"}
    assert len(PUSHING_BUTTONS.sequences(2)) == 6
    assert len(PUSHING_BUTTONS.sequences(3)) == 7


def test_four_pairs_are_taught():
    taught = names(PUSHING_BUTTONS.taught_pairs())
    assert len(taught) == 4
    assert names(PUSHING_BUTTONS.sequences(2)) - taught == {"LR ↑↓", "LL ↑↓"}


def test_three_triples_are_made_of_taught_pairs_and_four_are_not():
    triples = PUSHING_BUTTONS.sequences(3)
    trained = {m.name for m in triples if PUSHING_BUTTONS.is_taught(m)}
    assert trained == {"UR ↓↑←", "LR ↑←↓", "UR ←↓↑"}
    assert names(triples) - trained == {"UR ↓↑↓", "LR ↑↓↑", "UL ↓↑↓", "LL ↑↓↑"}


def test_every_sequence_runs_on_from_where_it_was():
    for length in (1, 2, 3, 4):
        for motion in PUSHING_BUTTONS.sequences(length):
            assert len(motion.corners) == length + 1
            assert all(a.end == b.start for a, b in motion.pairs())


@pytest.mark.parametrize("length", [1, 2, 3])
def test_a_motion_is_read_from_its_name_and_from_its_primitives(length):
    for motion in PUSHING_BUTTONS.sequences(length):
        assert PUSHING_BUTTONS.motion(motion.name) == motion
        assert PUSHING_BUTTONS.motion("+".join(p.name for p in motion.primitives)) == motion


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("UR ↑", "impossible sequence 'UR ↑': from UR only ↓, ←"),
        ("UR ↓←", "from LR only ↑"),
        ("PUSH(R)+SLIDE", "PUSH(R) ends at LR, SLIDE starts at UR"),
        ("PUSH(X)+SLIDE", "unknown primitive 'PUSH(X)'; did you mean 'PUSH("),
        ("XX ↓", "is no motion"),
        ("UR", "is no motion"),
        ("", "is no motion"),
    ],
)
def test_impossible_motions_are_told(text, told):
    with pytest.raises(TaskError) as error:
        PUSHING_BUTTONS.motion(text)
    assert told in str(error.value)


def test_a_motion_needs_a_primitive():
    with pytest.raises(TaskError, match="at least one primitive"):
        Motion(())


def test_curricula():
    phased = Curriculum(phase_1="primitives", phase_2="taught pairs")
    first, second = phased.lessons(PUSHING_BUTTONS)
    assert first == PUSHING_BUTTONS.sequences(1)
    assert second == PUSHING_BUTTONS.taught_pairs()
    listed = Curriculum(phase_1=["UR ↓", "UR ↓", "PUSH(L)"], phase_2="UR ↓↑")
    first, second = listed.lessons(PUSHING_BUTTONS)
    assert [m.name for m in first] == ["UR ↓", "UL ↓"]
    assert [m.name for m in second] == ["UR ↓↑"]
    with pytest.raises(TaskError, match="impossible sequence"):
        Curriculum(phase_1=["UR ↓↓"], phase_2="primitives").lessons(PUSHING_BUTTONS)
