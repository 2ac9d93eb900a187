"""Fresh demonstrations on the physical body, recognised by a learner that has learned a little."""

from collections import Counter

import numpy as np
import pytest

from motionese.experiment import read_settings
from motionese.imitation import Scene, Stage, Until, imitation_loop, newborn
from motionese.imitation.roles import exchanged, lesioned, recognised
from motionese.task import PUSHING_BUTTONS

LESSON = PUSHING_BUTTONS.lesson("branching")
SMALL = ["network.levels.cf.size=8", "training.epochs=20", "recognition.iterations=5"]
DEMONSTRATIONS = 2


@pytest.fixture(scope="module")
def learned():
    scene = Scene(read_settings(overrides=SMALL, quick=True), seed=3)
    stage = Stage(LESSON, 3, scene.settings.caregiver, Until(loops=1))
    return scene, imitation_loop(scene, newborn(scene, 3), stage, 1, len(LESSON))[0]


@pytest.fixture(scope="module")
def lesson(learned):
    scene, learner = learned
    scene.perform = None  # to recognise, nothing is performed
    settings = scene.settings.recognition.model_copy(update={"starts": 0})
    return recognised(scene, learner, LESSON, settings, DEMONSTRATIONS)


@pytest.mark.slow
def test_fresh_demonstrations_of_every_motion_are_recognised(learned, lesson):
    scene, learner = learned
    assert [(d.sequence, d.number) for d in lesson.demonstrations] == [
        (sequence, number) for sequence in LESSON for number in (1, 2)
    ]
    assert lesson.sequences == LESSON and lesson.left_out == 0
    for each in lesson.demonstrations:
        watched = scene.show(each.sequence, "roles", each.number)
        own = scene.as_own(each.sequence.start, watched)
        np.testing.assert_array_equal(each.first, own[0])
        np.testing.assert_array_equal(each.seen, scene.body.bearing(watched.sensed))
        assert each.begins == watched.begins == (0, 14)
        assert not np.array_equal(
            each.seen, scene.body.bearing(scene.show(each.sequence, "loop", 1).sensed)
        )
        learned_states = learner.repertoire()
        assert not (each.initial_state == learned_states).all(axis=1).any()
    assert lesson.network is learner.network


@pytest.mark.slow
def test_strokes_go_where_the_task_says_as_the_robot_sees_them(lesson):
    signs = {"↓": -np.pi / 2, "↑": np.pi / 2, "←": np.pi}
    assert set(lesson.primitives) == set(PUSHING_BUTTONS.primitives)
    seen = [(p.sign, angle) for p, angle in lesson.primitives.items()]
    for each in lesson.demonstrations:
        seen += zip([p.sign for p in each.sequence.primitives], each.directions, strict=True)
    for sign, angle in seen:
        assert np.cos(angle - signs[sign]) > np.cos(np.radians(15))


def test_a_lesson_of_the_task_is_judged_where_its_motions_differ(lesson):
    rows = exchanged(lesson)
    pairs = {(r["kind"], r["motion_lower"], r["motion_upper"]) for r in rows}
    assert pairs == {
        ("first", "UR ↓↑", "UR ←↓"),
        ("first", "UR ←↓", "UR ↓↑"),
        ("order", "LR ↑←", "LR ↑↓"),
        ("order", "LR ↑↓", "LR ↑←"),
    }
    assert len(rows) == len(pairs) * DEMONSTRATIONS


def test_lesions_of_a_lesson_of_the_task(lesson):
    rows = lesioned(lesson)
    assert Counter(row["lesion"] for row in rows) == dict.fromkeys(
        ("none", "cf_0 to its mean", "cs_0 to its mean", "cs → cf cut"),
        len(LESSON) * DEMONSTRATIONS * 2,
    )
    ambiguous = {(row["motion"], row["stroke"]) for row in rows if row["ambiguous"]}
    assert ambiguous == {("UR ↓↑", 1), ("UR ←↓", 1), ("LR ↑←", 2), ("LR ↑↓", 2)}
