"""Which primitives are clear: measured of networks that are known; the undefined is told."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.imitation import newborn
from motionese.teaching.emergence import (
    CLEAR,
    Direction,
    Following,
    emergence_of,
    following_of,
    missing_of,
)
from motionese.teaching.interactive_map import ELSEWHERE, HARDLY, InteractiveMap
from motionese.teaching.recogniser import Recogniser
from motionese.teaching.session_folder import SessionFolder
from motionese.teaching.state_plane import plane_of


@pytest.fixture(scope="module")
def tall(scene):
    return newborn(scene, 3)


def knowing(learner, scene, *names):
    """A robot that has lived through sequences, and trained on none."""
    for loop, name in enumerate(names, 1):
        sequence = scene.task.sequence(name)
        values = scene.as_own(sequence.start, scene.show(sequence, "known"))
        state = np.zeros(learner.network.size)
        state[learner.network.units(learner.network.names[-1])][:2] = loop
        learner = learner.experiencing(loop, name, values, state)
    return learner


def silent(learner):
    """The robot with its slow level cut off from the fast one."""
    network = learner.network
    weights = np.array(network.weights)
    weights[network.units("cf"), network.units("cs")] = 0
    return replace(learner, network=replace(network, weights=weights))


def measured(scene, learner, number=1):
    """What has emerged, and how many parts it was measured in."""
    parts, measuring = 0, emergence_of(scene, learner, number, Recogniser(scene, learner))
    while True:
        try:
            next(measuring)
        except StopIteration as ended:
            return ended.value, parts
        parts += 1


def test_a_state_is_held_but_for_where_it_lies_in_the_plane(scene, tall, fresh):
    rng = np.random.default_rng(0)
    for learner in (tall, fresh, knowing(fresh, scene, "UR ↓", "UR ←")):
        plane, state = plane_of(learner, 5.0), rng.normal(size=learner.network.size)
        to = rng.normal(size=(3, 4, 2))
        moved = plane.moved(state, to)
        assert moved.shape == (3, 4, len(state))
        np.testing.assert_allclose(moved[..., plane.units] @ plane.axes.T, to, atol=1e-9)
        np.testing.assert_allclose(plane.axes @ plane.axes.T, np.eye(2), atol=1e-9)
        np.testing.assert_allclose(plane.moved(state, plane.coordinates(state)), state, atol=1e-9)
        outside = np.delete(moved, np.r_[plane.units], axis=-1)
        assert (outside == np.delete(state, np.r_[plane.units])).all()
    assert plane_of(tall, 5.0).slow and not plane_of(fresh, 5.0).slow


def test_the_map_reaches_beyond_all_that_was_learned(scene, fresh):
    far = knowing(fresh, scene, "UR ↓")
    experience = far.experiences[0]
    states = np.full_like(experience.initial_state, 4.0)
    far = replace(far, experiences=(replace(experience, initial_state=states),))
    plane = plane_of(far, 5.0)
    assert np.abs(plane.coordinates(states)).max() == pytest.approx(plane.reach / 1.2)
    assert plane_of(fresh, 5.0).reach == 5.0, "nothing was learned"


def test_a_slow_level_that_is_cut_off_turns_nothing(scene, tall):
    drawn = InteractiveMap(scene, silent(tall))
    for name, (first, second) in drawn.strokes.items():
        assert len(set(first.ways)) == len(set(second.ways)) == 1
        assert drawn.share(name) in (0.0, 1.0)
    ways = {way for pair in drawn.strokes.values() for each in pair for way in each.ways}
    assert ways <= {*drawn.strokes, ELSEWHERE, HARDLY}


def test_ways_are_told_by_direction_and_by_length(scene, fresh):
    drawn = InteractiveMap(scene, fresh)
    (down, far), (left, wide) = drawn.true["UR ↓"], drawn.true["UR ←"]
    made = [[down + 0.7, far], [left, 0.6 * wide], [down, 0.4 * far], [down + np.pi, far]]
    told = drawn._told(np.array(made), "UR")
    assert told.known == ("UR ↓", "UR ←")
    assert told.ways == ("UR ↓", "UR ←", HARDLY, ELSEWHERE)
    assert told.share("UR ↓") == 0.25


def test_every_point_of_a_map_has_a_motion(scene, fresh, tall):
    for learner in (fresh, tall):
        drawn = InteractiveMap(scene, learner)
        assert len(drawn.strokes) == 5
        assert {len(s.ways) for pair in drawn.strokes.values() for s in pair} == {
            scene.settings.evaluation.map_points**2
        }
        assert drawn.motion("UR ↓", (0.0, 1.0)).shape == (28, 3)
        assert drawn.motion("../../etc", (0.0, 1.0)) is None


def test_a_newborn_has_nothing_clear_whatever_it_does_by_chance(scene, fresh, tall):
    for learner in (fresh, tall):
        found, _ = measured(scene, learner)
        assert [d.share for d in found.directions] == [d.newborn for d in found.directions]
        assert not any(d.clear or d.learned for d in found.directions)
        assert all("not learned yet" in d.sentence(found.slow) for d in found.directions)
        assert found.sentence.startswith("0 of 5") and found.read == ()


def test_what_is_not_defined_is_told_with_what_is_missing(scene, fresh):
    known = knowing(fresh, scene, "UR ↓↑", "UR ←↓")
    assert "no slow level" in measured(scene, known)[0].first.missing
    task = scene.task
    first, order = missing_of([task.sequence("UR ↓↑")], task, slow=True)
    assert "such as UR ↓↑ and UR ←↓" in first and "such as LR ↑↓ and LR ↑←" in order
    first, order = missing_of([task.sequence(n) for n in ("UR ↓↑", "UR ←↓")], task, slow=True)
    assert first == "" and "LR ↑↓" in order
    longer = [task.sequence(n) for n in ("UR ↓↑↓", "UR ↓↑←")]
    assert missing_of(longer, task, slow=True)[1] == "", "they part in the third stroke"
    lonely = replace(task, primitives=task.primitives[:1], lessons={}, novel={})
    assert "No two sequences of this task" in missing_of([], lonely, slow=True)[0]


def test_it_is_counted_whose_strokes_follow():
    told = [("first", "lower"), ("order", "upper"), ("order", "upper"), ("order", "neither")]
    rows = [{"kind": kind, "follows": follows} for kind, follows in told]
    assert following_of(rows, "first", "") == Following(1, 0, 0)
    assert following_of(rows, "order", "") == Following(0, 2, 1)
    assert following_of(rows, "order", "why") == Following(missing="why")
    assert following_of(rows, "transfer", "").missing


@pytest.mark.slow
def test_levels_are_exchanged_and_read_part_by_part(scene, tall):
    known = knowing(tall, scene, "UR ↓↑", "UR ←↓", "LR ↑←", "LR ↑↓")
    found, parts = measured(scene, known, number=7)
    many = 2 * scene.settings.evaluation.roles.demonstrations
    for kind in (found.first, found.order):
        assert kind.missing == "" and kind.lower + kind.upper + kind.neither == many
    assert {r.level for r in found.read} <= {"cf", "cs"}
    assert all(0 <= r.score <= 1 and r.chance == 0.5 for r in found.read)
    assert parts > many, "nobody waits for all of it"
    assert (found.learner, found.levels) == (7, ("io", "cf", "cs"))
    assert {d.primitive for d in found.directions if not d.learned} == {"LL ↑"}


def test_a_stroke_is_clear_that_was_learned_and_goes_its_way_nearly_everywhere():
    almost = Direction("UR ↓", CLEAR, 0.2, learned=True)
    assert almost.clear and almost.sentence(True) == "clear: 90 % of the map goes that way"
    assert not replace(almost, learned=False).clear
    turned = replace(almost, share=0.64)
    assert turned.sentence(True) == "not yet: 64 % of the map goes that way"
    assert replace(almost, share=0.0).sentence(False) == "not yet: goes another way"


@pytest.mark.slow
def test_what_emerged_is_measured_once_and_kept_with_the_session(teaching, tmp_path):
    assert sum(1 for _ in teaching.measured()) == 2
    (first,) = teaching.emerged
    assert list(teaching.measured()) == [] and teaching.emerged == (first,)
    SessionFolder(tmp_path).save(teaching)
    assert SessionFolder(tmp_path).read().emerged == (first,)
    known = replace(first, order=Following(1, 2, 3))
    teaching.standing = replace(teaching.standing, emerged=(known,))
    SessionFolder(tmp_path).save(teaching)
    assert SessionFolder(tmp_path).read().emerged == (known,)


def test_what_was_measured_of_a_network_that_is_taken_back_does_not_count(teaching, fresh):
    list(teaching.measured())
    began = teaching.standing
    teaching._become(fresh)
    list(teaching.measured())
    assert [e.learner for e in teaching.emerged] == [1, 2]
    teaching.return_to(replace(teaching.standing, learner=began.learner, number=began.number))
    assert [e.learner for e in teaching.emerged] == [1]
