"""Which stage the next loop belongs to follows from the loops so far, and from nothing else."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.caregiver import Manner
from motionese.imitation import LoopDone, Settled, Stage, Until, next_stage
from motionese.task import PUSHING_BUTTONS

MANNER = Manner(stroke_steps=12, rest_steps=2, variability_mm=0.0, persistence=0.0)


def stage(loops, settled=None):
    until = Until(loops=loops, settled=settled)
    return Stage(PUSHING_BUTTONS.sequences(1), 2, MANNER, until)


def gone_through(stages, errors):
    """Stages of the loops of a development whose errors follow each other so."""
    done = []
    while (now := next_stage(stages, done)) is not None:
        done.append(LoopDone(now, errors[len(done)]))
    return [loop.stage for loop in done]


def test_stages_of_so_many_loops_follow_each_other():
    assert gone_through([stage(2), stage(1), stage(3)], [9.0] * 6) == [0, 0, 1, 2, 2, 2]


def test_a_stage_ends_when_its_last_errors_are_small():
    adaptive = stage(9, Settled(loops=2, below_cm=2.0, share=1.0))
    errors = [9.0, 3.0, 1.9, 1.9, 9.0, 1.0, 1.0]
    assert gone_through([adaptive, adaptive], errors) == [0, 0, 0, 0, 1, 1, 1]


def test_errors_of_the_stage_before_say_nothing():
    adaptive = stage(9, Settled(loops=3, below_cm=2.0, share=1.0))
    assert gone_through([stage(3), adaptive], [1.0] * 6) == [0, 0, 0, 1, 1, 1]


@pytest.mark.parametrize(
    ("errors", "settled"),
    [
        ([], False),
        ([1.0, 1.0], False),
        ([1.9, 1.9, 1.9], True),
        ([9.0, 9.0, 9.0], False),
        ([9.0, 9.0, 9.0, 8.0, 8.0, 8.0], True),
        ([9.0, 9.0, 9.0, 5.0, 5.0, 5.0], False),
        ([9.0, 9.0, 5.0, 5.0, 5.0], False),
    ],
)
def test_learning_has_settled_when_errors_are_small_or_hardly_smaller(errors, settled):
    assert Settled(loops=3, below_cm=2.0, share=0.8).by(errors) == settled


@given(
    st.lists(st.integers(1, 5), min_size=1, max_size=4),
    st.lists(st.floats(0, 20), min_size=20, max_size=20),
)
def test_no_stage_lasts_longer_than_its_loops_and_none_is_left_out(loops, errors):
    stages = [stage(n, Settled()) for n in loops]
    stages_of = gone_through(stages, errors)
    assert stages_of == sorted(stages_of)
    for number, most in enumerate(loops):
        assert 1 <= stages_of.count(number) <= most
