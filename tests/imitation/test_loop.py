"""The imitation loop's five steps on the physical body, with networks too small to be any good."""

from dataclasses import replace

import numpy as np
import pytest

import motionese as mo
from motionese import runtime
from motionese.experiment import read_settings
from motionese.imitation import (
    Experience,
    Learner,
    Scene,
    Stage,
    Until,
    has_map,
    imitate,
    imitate_novel,
    imitation_loop,
    kept_of,
    map_slow_states,
    network_row,
    newborn,
    read_learner,
    sample_sequence,
    write_learner,
)
from motionese.imitation.keys import key_for
from motionese.learning import activity
from motionese.network import MTRNN, Level
from motionese.task import PUSHING_BUTTONS

SMALL = [
    "network.levels.cf.size=8",
    "training.epochs=20",
    "recognition.iterations=5",
    "evaluation.recognition.iterations=5",
    "evaluation.map_points=3",
]
PAIRS = PUSHING_BUTTONS.lesson("taught pairs")[:2]
TRIPLES = PUSHING_BUTTONS.sequences(3)


def scene_of(*overrides):
    return Scene(read_settings(overrides=[*SMALL, *overrides], quick=True), seed=3)


def learner_of(scene, levels=2):
    return newborn(scene, levels)


def loop_of(scene, learner):
    stage = Stage(PAIRS, 2, scene.settings.caregiver, Until(loops=1))
    return imitation_loop(scene, learner, stage, 1, 6)


@pytest.fixture(scope="module")
def scene():
    return scene_of()


@pytest.fixture(scope="module")
def looped(scene):
    """One loop of a two-level network: before, after, rows."""
    before = learner_of(scene)
    after, rows, grown, status = loop_of(scene, before)
    return before, after, rows, grown, status


def test_a_demonstration_is_the_same_on_the_same_occasion_only(scene):
    one, same = (scene.show(PAIRS[0], "loop", 1) for _ in range(2))
    other = scene.show(PAIRS[0], "loop", 2)
    assert np.array_equal(one.sensed, same.sensed) and np.array_equal(one.path, same.path)
    assert not np.array_equal(one.path, other.path)


def test_recognition_knows_of_its_arm_only_where_it_starts(scene):
    watched = scene.show(PAIRS[0], "loop", 1)
    own = scene.as_own(PAIRS[0].start, watched)
    assert np.array_equal(own[:, 2:], watched.sensed[:, 2:])
    np.testing.assert_array_equal(own[:, scene.joints], np.tile(scene.postures["UR"], (28, 1)))


def test_recognition_does_not_look_at_the_demonstrators_arm_channels(scene):
    learner = learner_of(scene)
    found = imitate(scene, learner, PAIRS, scene.settings.recognition, "loop", 1)
    shown = scene.as_own

    def disturbed(start, watched):
        values = shown(start, watched)
        values[1:, scene.joints] += 0.1
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
        errors = {name: value for name, value in row.items() if name.endswith("_cm")}
        assert errors.keys() == {
            "imitation_error_cm",
            "recognition_residual_cm",
            "model_error_cm",
            "reproduction_error_cm",
            "reproduction_strokes_cm",
        }
        strokes = [float(each) for each in errors["reproduction_strokes_cm"].split()]
        assert np.mean(strokes) == pytest.approx(errors["reproduction_error_cm"], abs=0.01)
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
    again, rows_again, _, _ = loop_of(scene_of(), before)
    assert np.array_equal(after.network.weights, again.network.weights)
    for row in (*rows, *rows_again):
        row.pop("seconds", None)
    np.testing.assert_equal(rows_again, rows)


def test_an_efference_copy_holds_commands_and_no_copy_holds_what_was_sensed(scene):
    done = scene.perform(learner_of(scene).network, np.zeros(14), PAIRS[0], 28, "test")
    copied, sensed = done.experience(True), done.experience(False)
    assert np.array_equal(copied[:, scene.joints], done.commanded)
    assert np.array_equal(sensed, done.sensed)
    assert np.array_equal(copied[:, 2:], sensed[:, 2:])
    assert not np.allclose(copied, sensed)


def test_what_is_commanded_is_what_the_network_predicted(scene):
    done = scene.perform(learner_of(scene).network, np.zeros(14), PAIRS[0], 28, "test")
    np.testing.assert_allclose(done.commanded[1:], done.predicted[1:, scene.joints], atol=1e-9)


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
    unknown = np.full(6, np.nan)
    kept = [Experience(loop, m, values, state, unknown) for loop in range(5) for m in ("a", "b")]
    learner = replace(learner, experiences=tuple(kept))

    def loops(memory, rehearsed=frozenset()):
        return [(e.loop, e.motion) for e in learner.remembering(4, memory, rehearsed).experiences]

    assert loops(1) == [(4, "a"), (4, "b")]
    assert loops(3) == [(i, m) for i in (2, 3, 4) for m in ("a", "b")]
    assert loops(9) == [(i, m) for i in (1, 2, 3, 4) for m in ("a", "b")], "babbling is left behind"
    learner = replace(learner, experiences=tuple(e for e in kept if (e.motion, e.loop) != ("a", 4)))
    assert loops(1) == [(4, "b")]
    assert loops(1, frozenset({"a"})) == [(3, "a"), (4, "b")]


def test_growth_keeps_what_was_learned(scene, looped):
    _, learner, _, _, _ = looped
    grown = learner.grown(scene.settings.network, key_for(3, "growth"))
    assert [level.name for level in grown.network.levels] == ["io", "cf", "cs"]
    assert np.array_equal(grown.network.weights[:14, :14], learner.network.weights)
    for old, new in zip(learner.experiences, grown.experiences, strict=True):
        assert np.array_equal(new.initial_state, [*old.initial_state, 0.0, 0.0])
    row = network_row(grown)
    block = grown.network.weights[6:14, 14:]
    assert row["rms_cs_to_cf"] == pytest.approx(float(np.sqrt((block**2).mean())))
    assert row["largest_cs_0"] == 0.0


def test_errors_are_those_of_what_was_shown_and_done(scene):
    learner = learner_of(scene)
    (each,) = imitate(scene, learner, PAIRS[:1], scene.settings.recognition, "t")
    done, shown = each.performance, each.watched
    row = each.measures(scene)
    apart = np.linalg.norm(done.path - shown.path, axis=1)
    assert row["imitation_error_cm"] == pytest.approx(100 * apart.mean())
    eye = scene.body.eye_position
    rays = [_rays(scene.body.bearing(v)) for v in (done.sensed, done.predicted)]
    angles = np.arccos(np.clip((rays[0] * rays[1]).sum(-1), -1, 1))
    across = 100 * angles * np.linalg.norm(done.path - eye, axis=1)
    assert row["model_error_cm"] == pytest.approx(across.mean(), abs=1e-3)


def _rays(bearing):
    azimuth, elevation = bearing.T
    level = np.cos(elevation)
    return np.stack([level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)], axis=-1)


@pytest.mark.parametrize("feedback", [0.0, 0.5])
def test_the_activity_kept_is_that_of_the_performance(feedback):
    scene = scene_of(f"imitation.feedback={feedback}")
    network = learner_of(scene).network
    done = scene.perform(network, np.zeros(14), PAIRS[0], 28, "test")
    own = scene.body.channels.from_unit(done.activity[:, :6])
    np.testing.assert_allclose(own, done.predicted, atol=1e-5)
    first = done.experience(True)[0]
    state = np.zeros(14)
    state[:6] = -np.log(1 / scene.body.channels.to_unit(first) - 1)
    closed = activity(network, state, 28, first=first)
    apart = np.abs(closed - done.activity).max()
    assert apart < 1e-5 if feedback == 0 else apart > 0.01


def test_a_learner_is_written_as_a_fit(scene, looped, tmp_path):
    _, learner, _, _, _ = looped
    path = tmp_path / "loop-01.safetensors"
    write_learner(path, learner, scene.body.rate_hz, {"loop": 1})
    again, facts = read_learner(path)
    assert facts == {"loop": 1}
    assert np.array_equal(again.network.weights, learner.network.weights)
    for one, other in zip(learner.experiences, again.experiences, strict=True):
        assert (one.loop, one.motion, one.begins) == (other.loop, other.motion, other.begins)
        assert np.array_equal(one.values, other.values)
        assert np.array_equal(one.initial_state, other.initial_state)
    assert any(len(each.begins) > 1 for each in again.experiences)
    fit = mo.load(path)
    assert fit.names == tuple(e.name for e in learner.experiences)
    assert fit.network.channels == scene.body.channels and fit.rate_hz == scene.body.rate_hz
    model = runtime.load(path)
    player = runtime.Player(model, model.begin(fit.names[0]))
    played = [player.row, *(player.step() for _ in range(27))]
    generated = mo.generate(fit.network, fit.initial_states[0], 28)
    width = scene.body.channels.interval_widths
    assert np.abs((np.array(played) - generated) / width).max() < 1e-6


@pytest.mark.slow
def test_evaluation_of_new_sequences(scene):
    learner = learner_of(scene, levels=3)
    taught = (*PUSHING_BUTTONS.sequences(1), *PUSHING_BUTTONS.lesson("taught pairs"))
    rows, imitated = imitate_novel(scene, learner, TRIPLES, taught)
    assert len(rows) == 7 and sum(row["trained"] for row in rows) == 3
    lesson = PUSHING_BUTTONS.sequence("UR ↓↑↓")
    others, _ = imitate_novel(scene, learner, TRIPLES, (*taught, lesson))
    assert {row["motion"] for row in rows} - {row["motion"] for row in others} == {lesson.name}
    rest, _ = imitate_novel(scene, learner, TRIPLES, scene.task.lesson("pairs and triples"))
    assert {row["motion"] for row in rows} - {row["motion"] for row in rest} == {
        "UR ↓↑←",
        "UR ↓↑↓",
    }
    kept = kept_of(scene.task, imitated)
    sample = next(each for each in imitated if each.sequence == sample_sequence(scene.task))
    assert np.array_equal(kept["activity"], sample.performance.activity)
    assert kept["activity"].shape == (42, learner.network.size)
    assert kept["begins"].tolist() == [0, 14, 28]
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
    one_unit = MTRNN.draw(
        [Level(6, 2.0), Level(8, 5.0), Level(1, 70.0)],
        key=key_for(0),
        channels=scene.body.channels,
    )
    assert not has_map(scene, one_unit)
    assert map_slow_states(scene, Learner(one_unit)) == []


def test_a_robot_that_predicts_variances_learns_them_and_grows(tmp_path):
    scene = scene_of("training.error=gaussian")
    before = learner_of(scene).grown(scene.settings.network, key_for(3, "network"))
    after, rows, _, status = loop_of(scene, before)
    assert not status.failed and len(rows) == len(PAIRS)
    read_out = [learner.network.variance_weights for learner in (before, after)]
    assert read_out[0].shape == read_out[1].shape and (read_out[0] != read_out[1]).any()
    write_learner(tmp_path / "robot.safetensors", after, 5.0, {})
    robot = runtime.load(tmp_path / "robot.safetensors")
    assert len(robot.channels) == len(scene.body.channels)
