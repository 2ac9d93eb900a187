"""What every task promises; a further task is a row of TASKS and is tested here."""

import mujoco
import numpy as np
import pytest

from motionese.caregiver import intended_way, sequence_in
from motionese.errors import TaskError
from motionese.task import TASKS, Attempt, PrimitiveSequence, task_named

every_task = pytest.mark.parametrize("task", TASKS.values(), ids=TASKS)


def attempt(task, sequence, rows=20):
    count = len(sequence.primitives)
    path = np.repeat(task.position(sequence.start)[None], rows * count, axis=0)
    effects = {name: np.zeros(rows * count) for name in task.effects}
    return Attempt(tuple(rows * i for i in range(count)), path, path, effects)


@every_task
def test_it_is_found_by_its_name(task):
    assert task_named(task.name) is task
    with pytest.raises(TaskError, match="unknown task"):
        task_named(task.name + "?")


@every_task
def test_a_primitive_is_known_by_its_start_and_its_sign(task):
    assert len({(p.start, p.sign) for p in task.primitives}) == len(task.primitives)
    assert len({p.name for p in task.primitives}) == len(task.primitives)
    assert all(len(p.sign) == 1 for p in task.primitives)


@every_task
@pytest.mark.parametrize("length", [1, 2, 3, 4])
def test_sequences_run_on_and_are_read_from_their_names(task, length):
    for sequence in task.sequences(length):
        assert all(a.end == b.start for a, b in sequence.pairs())
        assert task.sequence(sequence.name) == sequence
        assert task.sequence("+".join(p.name for p in sequence.primitives)) == sequence
        assert task.in_words(sequence).startswith("from ")


@every_task
def test_a_way_leads_from_place_to_place(task):
    for p in task.primitives:
        ends = task.position(p.start), task.position(p.end)
        path = p.way(np.array([0.0, 1.0]), *ends)
        np.testing.assert_allclose(path, ends, atol=1e-4)


@every_task
def test_the_first_lesson_is_made_of_taught_pairs_and_every_lesson_leaves_something_new(task):
    new = {s for name in task.novel for s in task.lesson(name)}
    first = task.lesson(next(iter(task.lessons)))
    assert new.isdisjoint(first) and all(task.is_taught(s) for s in first)
    for name in task.lessons:
        assert new - set(task.lesson(name))


@every_task
def test_a_lesson_is_called_by_its_name_in_whatever_order_it_is_listed(task):
    for name in ("primitives", *task.lessons):
        lesson = task.lesson(name)
        assert task.lesson_name(lesson) == task.lesson_name(lesson[::-1]) == name
        assert task.lesson_name(lesson[1:]) == ""


@every_task
def test_success_is_measured_in_the_columns_that_are_announced(task):
    for sequence in (*task.sequences(1), *(s for n in task.novel for s in task.lesson(n))):
        columns = task.achieved(sequence, attempt(task, sequence))
        announced = {c for o in task.outcomes for c in (o.column, o.of) if c}
        assert announced <= columns.keys()


@every_task
def test_its_things_tell_its_effects(task):
    model = mujoco.MjModel.from_xml_string(task.fixtures)
    joints = {model.joint(i).name for i in range(model.njnt)}
    assert set(task.effects) <= joints
    assert {p.effect for p in task.primitives} - {""} <= set(task.effects)


@every_task
def test_a_place_elsewhere_is_a_setting_and_an_unknown_place_is_told(task):
    name = next(iter(task.places))
    moved = task.with_places({name: (0.4, 0.0, 0.9)})
    np.testing.assert_array_equal(moved.position(name), [0.4, 0.0, 0.9])
    with pytest.raises(TaskError, match="unknown place 'nowhere'"):
        task.with_places({"nowhere": (0.0, 0.0, 0.0)})


@every_task
def test_what_does_not_meet_is_refused(task):
    apart = next((a, b) for a in task.primitives for b in task.primitives if a.end != b.start)
    with pytest.raises(TaskError, match="impossible sequence"):
        PrimitiveSequence(apart)


@every_task
def test_a_shown_way_is_understood_as_its_sequence(task):
    rng = np.random.default_rng(0)
    for sequence in (*task.sequences(1), *task.sequences(2), *task.sequences(3)):
        way = intended_way(sequence, task, 40)
        aside = np.cumsum(0.001 * rng.standard_normal(way.shape), axis=0)
        assert sequence_in(way + aside, task) == sequence
