"""What lessons demand of memory: known values, a twin by the chain rule, and what always holds."""

from itertools import chain

import pytest
from by_hand import memory_demand as by_hand
from hypothesis import given
from hypothesis import strategies as st

from motionese.task import PUSHING_BUTTONS, TASKS, MemoryDemand, memory_demand

STROKE, REST = 12, 2


def rows_of(primitive_rows):
    return lambda sequence: primitive_rows * len(sequence.primitives)


def numbers(demand):
    return demand.corner, demand.last, demand.history, demand.hold, demand.load


@pytest.mark.parametrize(
    ("lesson", "rest", "history", "hold", "load"),
    [
        ("primitives", REST, 0.0, 0, 0.0),
        ("taught pairs", REST, 0.0, 0, 0.0),
        ("branching", REST, 2 / 5, 14, 5.6),
        ("branching", 8, 2 / 5, 20, 8.0),
        ("all pairs", REST, 2 / 6, 14, 14 / 3),
        ("pairs and triples", REST, 4 / 8, 28, 10.5),
    ],
)
def test_lessons_of_the_buttons(lesson, rest, history, hold, load):
    demand = memory_demand(PUSHING_BUTTONS.lesson(lesson), rows_of(STROKE + rest))
    assert (demand.history, demand.hold, demand.load) == pytest.approx((history, hold, load))


@pytest.mark.parametrize(
    ("lesson", "corner", "last", "history"),
    [
        # From UR, reached by ↑, the way on is open where the start does not tell it.
        (["LR ↑↓", "LR ↑←"], 1.0, 1.0, 1.0),
        (["LR ↑↓", "UR ↓↑←"], 2 / 3, 2 / 3, 0.0),
        # UL is reached by ← or by ↑ and left by ↓ alone.
        (["UR ←↓", "LL ↑↓"], 0.0, 0.0, 0.0),
    ],
)
def test_who_knows_more_has_less_to_remember(lesson, corner, last, history):
    demand = memory_demand(PUSHING_BUTTONS.lesson(lesson), rows_of(14))
    assert (demand.corner, demand.last, demand.history) == pytest.approx((corner, last, history))


def test_the_last_primitive_tells_what_the_place_leaves_open():
    lesson = TASKS["shapes"].lesson(["T ↘←", "UR ↓←", "T ◝◡"])
    demand = memory_demand(lesson, rows_of(14))
    assert demand.corner == pytest.approx(0.9183, abs=1e-4)  # of 1/3 and 2/3
    assert demand.last == demand.history == demand.load == 0.0


def test_the_demand_in_words():
    told = memory_demand(PUSHING_BUTTONS.lesson("branching"), rows_of(14)).sentence
    assert told == "the way on must be remembered for 14 steps; 0.40 bit a transition"
    none = "this lesson asks for no memory of order"
    for lesson in ("taught pairs", "primitives"):
        assert memory_demand(PUSHING_BUTTONS.lesson(lesson), rows_of(14)).sentence == none
    assert memory_demand((), rows_of(14)) == MemoryDemand(0.0, 0.0, 0.0, 0, 0.0)


SEQUENCES = [[s for n in (1, 2, 3, 4) for s in task.sequences(n)] for task in TASKS.values()]
lessons = st.one_of(*(st.lists(st.sampled_from(each), max_size=20) for each in SEQUENCES))


@given(lessons, st.integers(2, 40))
def test_as_by_hand(lesson, primitive_rows):
    walks = [[s.start, *chain.from_iterable((p.name, p.end) for p in s.primitives)] for s in lesson]
    found = numbers(memory_demand(lesson, rows_of(primitive_rows)))
    assert found == pytest.approx(by_hand.memory_demand(walks, primitive_rows), abs=1e-9)


@given(lessons)
def test_nobody_has_more_to_remember_who_knows_more(lesson):
    demand = memory_demand(lesson, rows_of(14))
    assert 0 <= demand.history <= demand.last + 1e-9 <= demand.corner + 2e-9
    assert (demand.hold > 0) == (demand.load > 0) == (demand.history > 0)
    assert 0 <= demand.load <= demand.history * demand.hold + 1e-9


@given(lessons, st.randoms(use_true_random=False), st.integers(2, 3))
def test_neither_order_nor_repetition_of_the_whole_changes_it(lesson, random, times):
    expected = numbers(memory_demand(lesson, rows_of(14)))
    mixed = random.sample(lesson * times, len(lesson) * times)
    assert numbers(memory_demand(mixed, rows_of(14))) == pytest.approx(expected, abs=1e-12)


@given(lessons, st.integers(2, 5))
def test_who_moves_slower_makes_hold_and_load_longer_alone(lesson, times):
    quick, slow = (memory_demand(lesson, rows_of(rows)) for rows in (14, 14 * times))
    assert (slow.corner, slow.last, slow.history) == (quick.corner, quick.last, quick.history)
    assert (slow.hold, slow.load) == pytest.approx((quick.hold * times, quick.load * times))
