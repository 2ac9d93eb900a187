"""The imitation loop's five steps on the physical body, with networks too small to be any good."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.caregiver import PUSHING_BUTTONS
from motionese.experiment.evaluation import imitate_new_motions, inside, map_slow_states
from motionese.experiment.imitation_loop import development, imitate, imitation_loop
from motionese.experiment.keys import key_for
from motionese.experiment.learner import Experience, Learner
from motionese.experiment.perform import ARM
from motionese.experiment.reading import read_settings
from motionese.experiment.scene import Scene
from motionese.network import MTRNN, Level

SMALL = [
    "network.levels.cf.size=8",
    "training.epochs=20",
    "recognition.iterations=5",
    "evaluation.recognition.iterations=5",
    "evaluation.map_points=3",
]
PAIRS = PUSHING_BUTTONS.taught_pairs()[:2]


def scene_of(*overrides):
    return Scene(read_settings(overrides=[*SMALL, *overrides], quick=True), seed=3)


def learner_of(scene, levels=2):
    drawn = scene.settings.network.drawn_levels()[:levels]
    network = MTRNN(drawn, key=key_for(3, "network"), channels=scene.body.channels)
    return Learner(network)


@pytest.fixture(scope="module")
def scene():
    return scene_of()


@pytest.fixture(scope="module")
def looped(scene):
    """One loop of a two-level network: before, after, rows."""
    before = learner_of(scene)
    after, rows, grown, status = imitation_loop(scene, before, PAIRS, 1, 6)
    return before, after, rows, grown, status


def test_a_demonstration_is_the_same_on_the_same_occasion_only(scene):
    one, same = (scene.show(PAIRS[0], "loop", 1) for _ in range(2))
    other = scene.show(PAIRS[0], "loop", 2)
    assert np.array_equal(one.sensed, same.sensed) and np.array_equal(one.path, same.path)
    assert not np.array_equal(one.path, other.path)


def test_recognition_knows_of_its_arm_only_where_it_starts(scene):
    watched = scene.show(PAIRS[0], "loop", 1)
    own = scene.as_own(PAIRS[0], watched)
    assert np.array_equal(own[:, 2:], watched.sensed[:, 2:])
    np.testing.assert_array_equal(own[:, ARM], np.tile(scene.postures["UR"], (28, 1)))


def test_recognition_does_not_look_at_the_demonstrators_arm_channels(scene):
    learner = learner_of(scene)
    found = imitate(scene, learner, PAIRS, scene.settings.recognition, "loop", 1)
    shown = scene.as_own

    def disturbed(motion, watched):
        values = shown(motion, watched)
        values[1:, ARM] += 0.1
        return values

    scene.as_own = disturbed
    try:
        again = imitate(scene, learner, PAIRS, scene.settings.recognition, "loop", 1)
    finally:
        del scene.as_own
    for one, other in zip(found, again, strict=True):
        assert np.array_equal(one.found.initial_state, other.found.initial_state)


def test_a_loop_measures_every_motion(scene, looped):
    _, _, rows, grown, status = looped
    assert [row["motion"] for row in rows] == [m.name for m in PAIRS]
    for row in rows:
        errors = [value for name, value in row.items() if name.endswith("_cm")]
        assert len(errors) == 4 and all(0 < error < 60 for error in errors)
        assert row["buttons_due"] >= row["buttons_pressed"] >= 0
    assert not status.failed
    assert grown["levels"] == 2 and "rms_cs_to_cf" not in grown


def test_a_loop_learns_from_what_the_own_body_did(scene, looped):
    before, after, _, _, _ = looped
    assert not np.array_equal(before.network.weights, after.network.weights)
    assert [e.motion for e in after.experiences] == [m.name for m in PAIRS]
    assert all(e.loop == 1 and e.values.shape == (28, 6) for e in after.experiences)
    bound = scene.settings.training.bound["cf"]
    context = np.abs([e.initial_state[6:] for e in after.experiences])
    assert 0 < context.max() <= bound


def test_a_loop_is_a_function_of_seed_and_learner(scene, looped):
    before, after, rows, _, _ = looped
    again, rows_again, _, _ = imitation_loop(scene_of(), before, PAIRS, 1, 6)
    assert np.array_equal(after.network.weights, again.network.weights)
    for row in (*rows, *rows_again):
        row.pop("seconds", None)
    np.testing.assert_equal(rows_again, rows)


def test_an_efference_copy_holds_commands_and_no_copy_holds_what_was_sensed(scene):
    done = scene.perform(learner_of(scene).network, np.zeros(14), PAIRS[0], 28, "test")
    copied, sensed = done.experience(True), done.experience(False)
    assert np.array_equal(copied[:, ARM], done.commanded)
    assert np.array_equal(sensed, done.sensed)
    assert np.array_equal(copied[:, 2:], sensed[:, 2:])
    assert not np.allclose(copied, sensed)


def test_what_is_commanded_is_what_the_network_predicted(scene):
    done = scene.perform(learner_of(scene).network, np.zeros(14), PAIRS[0], 28, "test")
    np.testing.assert_allclose(done.commanded[1:], done.predicted[1:, ARM], atol=1e-9)


def test_feedback_and_exploration_change_what_is_performed():
    plain, fed, explored = (
        scene_of(*over) for over in ([], ["imitation.feedback=0.5"], ["imitation.exploration=0.05"])
    )
    network = learner_of(plain).network
    paths = [
        s.perform(network, np.zeros(14), PAIRS[0], 28, "t").path for s in (plain, fed, explored)
    ]
    assert not np.allclose(paths[0], paths[1]) and not np.allclose(paths[0], paths[2])


def test_memory_and_rehearsal(scene):
    state, values = np.zeros(14), np.zeros((14, 6))
    learner = learner_of(scene)
    kept = [Experience(loop, m, values, state) for loop in range(5) for m in ("a", "b")]
    learner = replace(learner, experiences=tuple(kept))

    def loops(memory, rehearsed=frozenset()):
        return [(e.loop, e.motion) for e in learner.remembering(4, memory, rehearsed).experiences]

    assert loops(1) == [(4, "a"), (4, "b")]
    assert loops(3) == [(i, m) for i in (2, 3, 4) for m in ("a", "b")]
    assert loops(9) == [(i, m) for i in (1, 2, 3, 4) for m in ("a", "b")], "babbling is left behind"
    learner = replace(learner, experiences=tuple(e for e in kept if (e.motion, e.loop) != ("a", 4)))
    assert loops(1) == [(4, "b")]
    assert loops(1, frozenset({"a"})) == [(3, "a"), (4, "b")]


def test_recognition_starts_from_the_most_similar_motion_that_is_known(scene):
    learner = learner_of(scene)
    names = ["babbling", "UR ↓", "LR ↑", "UR ↓↑", "UR ←"]
    states = [np.full(14, float(i)) for i in range(len(names))]
    known = [Experience(1, n, np.zeros((2, 6)), s) for n, s in zip(names, states, strict=True)]
    learner = replace(learner, experiences=tuple(known))
    start = {
        name: learner.start_for(PUSHING_BUTTONS.motion(name))[0]
        for name in ("UR ↓↑←", "UR ←↓", "LR ↑←", "UR ↓")
    }
    assert start["UR ↓↑←"] == 3 and start["UR ←↓"] == 4 and start["LR ↑←"] == 2
    assert start["UR ↓"] == 3, "the latest with the same beginning"


def test_growth_keeps_what_was_learned(scene, looped):
    _, learner, _, _, _ = looped
    grown = learner.grown(scene.settings.network, key_for(3, "growth"))
    assert [level.name for level in grown.network.levels] == ["io", "cf", "cs"]
    assert np.array_equal(grown.network.weights[:14, :14], learner.network.weights)
    for old, new in zip(learner.experiences, grown.experiences, strict=True):
        assert np.array_equal(new.initial_state, [*old.initial_state, 0.0, 0.0])
    row = development(grown)
    block = grown.network.weights[6:14, 14:]
    assert row["rms_cs_to_cf"] == pytest.approx(float(np.sqrt((block**2).mean())))
    assert row["largest_cs_0"] == 0.0


def test_evaluation_of_new_motions(scene):
    learner = learner_of(scene, levels=3)
    lessons = scene.settings.lessons("TD")
    rows, imitated = imitate_new_motions(scene, learner, lessons)
    assert len(rows) == 7 and sum(row["trained"] for row in rows) == 3
    taught = PUSHING_BUTTONS.motion("UR ↓↑↓")
    others, _ = imitate_new_motions(scene, learner, (*lessons, (taught,)))
    assert {row["motion"] for row in rows} - {row["motion"] for row in others} == {taught.name}
    kept = inside(scene, learner, imitated)
    assert kept["activity"].shape == (42, learner.network.size)
    assert {name for name in kept if name.startswith("performed.")} == {
        f"performed.{row['motion']}" for row in rows
    }


def test_map_has_a_row_for_every_primitive_and_point(scene):
    rows = map_slow_states(scene, learner_of(scene, levels=3))
    assert len(rows) == 5 * 3 * 3
    assert {(row["cs_1"], row["cs_2"]) for row in rows} == {
        (a, b) for a in (-5.0, 0.0, 5.0) for b in (-5.0, 0.0, 5.0)
    }
    assert all(-np.pi <= row[f"direction_{i}_rad"] <= np.pi for row in rows for i in (1, 2))


def test_map_of_a_network_without_slow_level_is_empty(scene):
    assert map_slow_states(scene, learner_of(scene, levels=2)) == []
    one_unit = MTRNN(
        [Level(6, 2.0), Level(8, 5.0), Level(1, 70.0)],
        key=key_for(0),
        channels=scene.body.channels,
    )
    assert map_slow_states(scene, Learner(one_unit)) == []
