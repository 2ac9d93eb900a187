"""What comes next in a development follows from the loops so far, and from nothing else."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.caregiver import Manner
from motionese.imitation import Development, LoopDone, Mastered, Settled, Stage, Until
from motionese.imitation.readiness import Emerged, lesson_errors
from motionese.task import PUSHING_BUTTONS

MANNER = Manner(stroke_steps=12, rest_steps=2, variability_mm=0.0, persistence=0.0)
LESSON = PUSHING_BUTTONS.sequences(1)
NAMES = [sequence.name for sequence in LESSON]


def stage(loops, levels=2, **until):
    return Stage(LESSON, levels, MANNER, Until(loops=loops, **until))


def gone_through(development, errors, emerged=()):
    """Return the loops of a development whose errors (of all motions) follow each other so."""
    done = []
    while (now := development.next_stage(done)) is not None:
        error = dict.fromkeys(NAMES, errors[len(done)])
        share = {"cf": emerged[len(done)]} if emerged else {}
        levels = development.next_levels(now, done)
        done.append(LoopDone(now, error, levels, share))
    return done


def stages_of(stages, errors):
    return [loop.stage for loop in gone_through(Development(tuple(stages)), errors)]


def test_stages_of_so_many_loops_follow_each_other():
    assert stages_of([stage(2), stage(1), stage(3)], [9.0] * 6) == [0, 0, 1, 2, 2, 2]


def test_a_stage_may_last_until_so_many_loops_in_all():
    in_all = Stage(LESSON, 2, MANNER, Until(in_all=4))
    early = Stage(LESSON, 2, MANNER, Until(in_all=1))
    assert stages_of([stage(3), in_all, early], [9.0] * 9) == [0, 0, 0, 1, 2]
    assert Development((stage(3), in_all, early)).most_loops() == 5


def test_a_stage_ends_when_its_last_errors_are_small():
    adaptive = stage(9, settled=Settled(loops=2, below_cm=2.0, share=1.0))
    errors = [9.0, 3.0, 1.9, 1.9, 9.0, 1.0, 1.0]
    assert stages_of([adaptive, adaptive], errors) == [0, 0, 0, 0, 1, 1, 1]


def test_errors_of_the_stage_before_say_nothing():
    adaptive = stage(9, settled=Settled(loops=3, below_cm=2.0, share=1.0))
    assert stages_of([stage(3), adaptive], [1.0] * 6) == [0, 0, 0, 1, 1, 1]


def test_readiness_does_not_count_before_the_least_loops():
    adaptive = stage(9, least=4, mastered=Mastered(loops=1))
    assert stages_of([adaptive, stage(1)], [1.0] * 9) == [0, 0, 0, 0, 1]


def test_a_lesson_is_mastered_when_every_motion_is():
    until = Until(loops=9, mastered=Mastered(loops=2, below_cm=2.0))
    good, bad = dict.fromkeys(NAMES, 1.0), {**dict.fromkeys(NAMES, 1.0), NAMES[0]: 3.0}

    def over(*errors):
        done = [LoopDone(0, each, 2) for each in errors]
        return until.over(0, len(done), done, NAMES)

    assert not over(good) and not over(good, bad) and not over(bad, good)
    assert over(bad, good, good)
    halves = [dict.fromkeys(half, 1.0) for half in (NAMES[:3], NAMES[3:])]
    assert over(*halves, *halves) and not over(*halves, halves[0])


def test_a_motion_that_is_not_shown_counts_by_its_error_before():
    loops = [LoopDone(0, {"a": 3.0}, 2), LoopDone(0, {"b": 1.0}, 2), LoopDone(0, {"a": 1.0}, 2)]
    assert lesson_errors(loops, ["a", "b"]) == [float("inf"), 2.0, 1.0]


def test_network_and_lesson_change_by_clocks_of_their_own():
    opens = {2: Until(in_all=3), 3: Until(loops=2)}
    done = gone_through(Development((stage(4), stage(3)), opens), [9.0] * 7)
    assert [loop.stage for loop in done] == [0, 0, 0, 0, 1, 1, 1]
    assert [loop.levels for loop in done] == [2, 2, 2, 3, 3, 4, 4]


def test_a_level_opens_once_what_is_below_has_emerged():
    opens = {2: Until(in_all=6, emerged=Emerged(level="cf", loops=2, share=0.9))}
    development = Development((stage(8),), opens)
    for shares, opened in (([0.95, 0.2, 0.9, 0.9], 4), ([0.8] * 8, 6)):
        done = gone_through(development, [9.0] * 8, [*shares, *[0.0] * 8])
        assert [loop.levels for loop in done] == [2] * opened + [3] * (8 - opened)


def test_what_was_before_the_last_change_says_nothing():
    mastered = Mastered(loops=3, below_cm=2.0)
    development = Development((stage(9, mastered=mastered), stage(1)), {2: Until(in_all=2)})
    assert [loop.stage for loop in gone_through(development, [1.0] * 9)] == [0] * 5 + [1]


def test_a_stage_brings_its_levels_if_they_have_not_opened_before():
    development = Development((stage(2), stage(2, levels=3)), {2: Until(in_all=1)})
    assert [loop.levels for loop in gone_through(development, [9.0] * 4)] == [2, 3, 3, 3]
    late = Development((stage(2), stage(2, levels=3)), {2: Until(in_all=9)})
    assert [loop.levels for loop in gone_through(late, [9.0] * 4)] == [2, 2, 3, 3]


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
    st.lists(st.integers(3, 5), min_size=1, max_size=4),
    st.lists(st.floats(0, 20), min_size=20, max_size=20),
    st.integers(3, 20),
)
def test_no_stage_lasts_longer_than_its_loops_and_none_is_left_out(loops, errors, opened):
    stages = tuple(stage(n, settled=Settled()) for n in loops)
    development = Development(stages, {2: Until(in_all=opened, settled=Settled())})
    done = gone_through(development, errors)
    numbers, levels = [loop.stage for loop in done], [loop.levels for loop in done]
    assert numbers == sorted(numbers) and levels == sorted(levels)
    assert len(done) <= development.most_loops()
    for number, most in enumerate(loops):
        assert 1 <= numbers.count(number) <= most
