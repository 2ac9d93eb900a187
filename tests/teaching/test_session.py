"""A session with a robot that knows nothing: show, imitate, learn, forget, grow, and the map."""

import json

import numpy as np
import pytest
from typed import typed

import motionese as mo
from motionese import runtime
from motionese.body import Geometry
from motionese.caregiver import (
    DEMONSTRATIONS,
    SOMETHING_ELSE,
    intended_way,
    lasting,
    read_recorded,
)
from motionese.errors import StorageError
from motionese.experiment import read_settings
from motionese.imitation import Scene, newborn, read_learner
from motionese.interfaces.page.descriptions import scene_message
from motionese.recordings import read
from motionese.teaching.frames import film
from motionese.teaching.session import PRACTICE, GrowthError, Teaching
from motionese.teaching.session_folder import SessionFolder
from motionese.teaching.view import View


def diagonal(scene, aside_m=0.0):
    """A hand's path that is no motion of the task."""
    aside = np.array([0, aside_m, 0])
    ends = [scene.task.position(name) + aside for name in ("UR", "LL")]
    return scene.body.reachable(lasting(np.stack(ends), 20))


def nothing(*progress):
    """Be told, and do nothing."""


def test_what_is_shown_is_noted_and_imitated(teaching, draw):
    shown = teaching.show(draw("UR ↓↑"), "drawn")
    assert shown.entry.number == 1 and shown.entry.motion == "UR ↓↑"
    assert len(shown.interpretation.path) == len(shown.watched.path)
    begins = teaching.scene.settings.caregiver.begins(teaching.scene.task.sequence("UR ↓↑"))
    assert shown.watched.begins == pytest.approx(begins[:-1], abs=3), "a segment a stroke"
    trial = teaching.imitate()
    assert teaching.notebook.entry(1).errors_cm == (trial.error_cm,)
    assert teaching.notebook.entries == (teaching.observed.entry,)


def test_learning_practises_shows_every_try_and_tells_how_far_it_is(teaching, draw):
    teaching.show(draw("UR ←"), "webcam")
    told, tries = [], []
    lesson = teaching.learn(lambda done, of, now: told.append((done, of)), tries.append)
    epochs = teaching.scene.settings.training.epochs
    assert told == [(epochs * (i + 1), epochs * PRACTICE) for i in range(PRACTICE)]
    assert lesson.errors_cm == tuple(trial.error_cm for trial in tries)
    assert len(tries) == PRACTICE + 1, "the first is how it was before"
    entry = teaching.notebook.entry(1)
    errors = entry.errors_cm
    assert len(errors) in (PRACTICE + 1, PRACTICE + 2), "once more, where the last is not kept"
    assert errors[: PRACTICE + 1] == lesson.errors_cm
    assert errors[-1] == lesson.changes[0].after_cm == lesson.errors_cm[lesson.kept]
    assert entry.tried.error_cm == errors[-1], "the last try is kept"
    before, *after = teaching.notebook.curves["UR ←"]
    assert (before.error_cm, before.practised) == (errors[0], False)
    assert [(p.after, p.error_cm, p.practised) for p in after] == [(1, errors[-1], True)]
    assert teaching.imitate().error_cm == errors[-1]


@pytest.mark.slow
def test_a_lesson_leaves_the_robot_no_worse_at_what_it_was_taught_nor_overall(teaching, draw):
    for name in ("UR ←", "UR ↓", "UR ←"):
        teaching.show(draw(name), "drawn")
        before = errors_now(teaching)
        lesson = teaching.learn(nothing)
        after = errors_now(teaching)
        assert [c.motion for c in lesson.changes] == [name, *(before.keys() - {name})]
        assert {c.motion: c.after_cm for c in lesson.changes} == after
        assert lesson.changes[0].after_cm <= lesson.changes[0].before_cm
        changes = [(c.before_cm, c.after_cm) for c in lesson.changes]
        assert np.mean(changes, axis=0)[1] <= np.mean(changes, axis=0)[0]


def errors_now(teaching):
    """What a new session with the same robot misses by, at all that was taught."""
    again = Teaching(teaching.scene, teaching.learner, teaching.notebook)
    errors = {}
    for motion, shown in teaching.notebook.taught().items():
        again.show(shown.path, "drawn")
        errors[motion] = again.imitate().error_cm
    return errors


def test_a_robot_that_knows_nothing_says_what_must_come_before_growth(teaching, draw):
    teaching.show(draw("UR ←"), "drawn")
    with pytest.raises(GrowthError, match="First show me a motion and press Learn this"):
        teaching.grow(nothing)
    assert teaching.can_grow


def test_an_entry_that_is_looked_back_at_is_imitated_next(teaching, draw):
    for name in ("UR ←", "UR ↓"):
        teaching.show(draw(name), "drawn")
    assert teaching.look_back(1).entry.motion == "UR ←"
    teaching.imitate()
    assert [len(e.errors_cm) for e in teaching.notebook.entries] == [1, 0]
    assert teaching.look_back(7) is None


@pytest.mark.slow
def test_forgetting_the_last_learning_gives_the_network_back(teaching, draw, tmp_path, kept):
    folder = SessionFolder(tmp_path)
    teaching.show(draw("UR ←"), "drawn")
    folder.save(teaching)
    before = np.asarray(teaching.learner.network.weights)
    for _ in range(2):
        teaching.learn(nothing)
        folder.save(teaching)
    said = teaching.forget(1, folder.learner)
    assert "again what it was" in said
    np.testing.assert_array_equal(teaching.learner.network.weights, before)
    assert teaching.notebook.entries == () and teaching.notebook.curves == {}
    assert teaching.observed is None and teaching.forget(1, folder.learner) == ""


@pytest.mark.slow
def test_forgetting_an_earlier_learning_ends_its_rehearsal(teaching, draw, tmp_path, kept):
    folder = SessionFolder(tmp_path)
    for name in ("UR ←", "UR ↓"):
        teaching.show(draw(name), "drawn")
        folder.save(teaching)
        teaching.learn(nothing)
        folder.save(teaching)
    weights = np.asarray(teaching.learner.network.weights)
    assert "no longer rehearsed" in teaching.forget(1, folder.learner)
    assert {e.motion for e in teaching.learner.experiences} == {"UR ↓"}
    np.testing.assert_array_equal(teaching.learner.network.weights, weights)
    assert [e.number for e in teaching.notebook.entries] == [2]


@pytest.mark.slow
def test_growth_compares_the_same_imitations(teaching, draw, kept):
    for name in ("UR ←", "UR ↓", "UR ←"):
        teaching.show(draw(name), "drawn")
        teaching.learn(nothing)
    assert teaching.can_grow
    changes = teaching.grow(nothing)
    assert [c.motion for c in changes] == ["UR ←", "UR ↓"], "every motion once"
    assert {c.motion: c.after_cm for c in changes} == errors_now(teaching)
    assert not teaching.can_grow
    assert [level.name for level in teaching.learner.network.levels] == ["io", "cf", "cs"]
    assert teaching.imitate().state.shape == (teaching.learner.network.size,)


def levels_of(network):
    return dict(zip(network.names, network.sizes, strict=True))


def test_a_film_holds_every_body_twenty_times_a_second(teaching, draw):
    teaching.show(draw("UR ↓"), "drawn")
    performance, network = teaching.imitate().performance, teaching.learner.network
    geometry = Geometry(teaching.scene.body.model)
    made = film(geometry, levels_of(network), performance, 10.0)
    rows = len(performance.path)
    assert made.rate_hz == 20 and len(made) == 2 * rows - 1
    part = made.part(0, 4)
    assert len(part["poses"]) == 4 and len(part["poses"][0]) == 7 * len(geometry.bodies)
    assert set(part["activity"]) == {"io", "cf"} and len(part["activity"]["cf"][0]) == 40
    assert len(part["effects"][0]) == 2
    quaternions = made.columns["poses"].reshape(len(made), -1, 7)[..., 3:]
    np.testing.assert_allclose(np.linalg.norm(quaternions, axis=-1), 1, atol=1e-6)


def test_a_film_shows_what_went_on_inside_also_where_the_senses_are_listened_to(scene, draw):
    settings = scene.settings
    listening = settings.imitation.model_copy(update={"feedback": 0.5})
    scene = Scene(settings.model_copy(update={"imitation": listening}), 0)
    teaching = Teaching(scene, newborn(scene, 2))
    teaching.show(draw("UR ↓"), "drawn")
    done, network = teaching.imitate().performance, teaching.learner.network
    made = film(Geometry(scene.body.model), levels_of(network), done, 10.0)
    inside = np.concatenate([made.activity["io"], made.activity["cf"]], axis=1)
    np.testing.assert_allclose(inside[::2], done.activity, atol=1e-12)


def test_a_session_goes_on_from_its_folder(teaching, draw, tmp_path, kept):
    folder = SessionFolder(tmp_path / "new")
    teaching.show(draw("UR ←"), "scripted")
    folder.began = "fresh"
    teaching.learn(nothing)
    folder.save(teaching)
    again = SessionFolder(tmp_path / "new")
    assert again.exists
    other = again.read()
    assert again.id == folder.id and again.began == "fresh"
    assert other.notebook.learned == teaching.notebook.learned
    entry, written = other.notebook.entries[0], teaching.notebook.entries[0]
    assert entry.errors_cm == written.errors_cm
    assert_same_trial(entry.tried, written.tried)
    assert entry.demonstration.begins == written.demonstration.begins
    np.testing.assert_array_equal(entry.demonstration.path, written.demonstration.path)
    np.testing.assert_array_equal(other.learner.network.weights, teaching.learner.network.weights)
    assert other.standing.number == teaching.standing.number and other.numbers == teaching.numbers
    assert other.show(draw("UR ↓"), "drawn").entry.number == 2
    kept = {path.name for path in (tmp_path / "new").iterdir()}
    tried = f"tried-0001-{len(written.errors_cm):05d}.npz"
    learner = f"learner-{teaching.standing.number:05d}.safetensors"
    assert kept == {"session.json", "demonstrations.npz", "shown-0001.npz", tried, learner}
    assert read_learner(tmp_path / "new" / learner)[0].experiences


def assert_same_trial(one, other):
    assert (one.result, one.levels) == (other.result, other.levels)
    np.testing.assert_array_equal(one.state, other.state)
    done, written = one.performance, other.performance
    assert done.joints == written.joints and done.effects.keys() == written.effects.keys()
    for name in ("sensed", "commanded", "predicted", "potentials", "path", "poses"):
        np.testing.assert_array_equal(getattr(done, name), getattr(written, name))


@pytest.mark.parametrize("file", ["session.json", "shown-0001.npz", "tried-0001-00001.npz"])
@pytest.mark.parametrize("damage", ["missing", b"", b"[" * 100_000])
def test_a_damaged_session_names_the_file_and_what_can_be_done(
    teaching, draw, tmp_path, file, damage
):
    folder = SessionFolder(tmp_path)
    teaching.show(draw("UR ←"), "drawn")
    teaching.imitate()
    folder.save(teaching)
    (tmp_path / file).unlink() if damage == "missing" else (tmp_path / file).write_bytes(damage)
    with pytest.raises(StorageError, match=rf"{file} cannot be read.*put the file back"):
        SessionFolder(tmp_path).read()


def test_saving_changes_nothing_of_the_session(teaching, draw, tmp_path, kept):
    teaching.show(draw("UR ←"), "drawn")
    for change in (lambda: None, lambda: teaching.learn(nothing)):
        change()
        before, numbers = teaching.standing, teaching.numbers
        SessionFolder(tmp_path).save(teaching)
        assert teaching.standing is before and teaching.numbers == numbers
    began = teaching.notebook.learned[0].before
    assert began != teaching.standing.number, "every learner has a number of its own"


def test_what_was_taught_goes_to_a_robot(teaching, draw, tmp_path, kept):
    teaching.show(draw("UR ←"), "drawn")
    teaching.learn(nothing)
    SessionFolder(tmp_path).save(teaching)
    (file,) = tmp_path.glob("learner-*.safetensors")
    fit = mo.load(file)
    taught = teaching.learner.experiences[-1]
    assert taught.name in fit.names and np.isfinite(fit.closed_loop_error).all()
    expected = mo.generate(fit.network, taught.initial_state, 10, first=taught.values[0])
    model = runtime.load(file)
    player = runtime.Player(model, model.begin(taught.name, taught.values[0]))
    np.testing.assert_allclose(
        [player.step() for _ in range(9)], expected[1:], rtol=1e-3, atol=1e-4
    )
    new = str(tmp_path / "new.csv")
    assert typed("generate", str(file), "--like", taught.name, "--out", new)[::2] == (0, "")
    (path,) = mo.Motions.read(new).values
    own = mo.generate(fit.network, taught.initial_state, len(taught.values))
    np.testing.assert_allclose(path, own, rtol=1e-4, atol=1e-4)


def test_what_a_killed_process_has_left_is_not_taken_for_what_is_new(
    teaching, draw, tmp_path, kept
):
    folder = SessionFolder(tmp_path)
    folder.save(teaching)
    for left in ("shown-0001.npz", "learner-00002.safetensors"):
        (tmp_path / left).write_bytes(b"of a session that was not finished")
    again = folder.read()
    again.show(draw("UR ←"), "drawn")
    again.learn(nothing)
    folder.save(again)
    entry = SessionFolder(tmp_path).read().notebook.entries[0]
    np.testing.assert_array_equal(entry.drawn, again.notebook.entries[0].drawn)


def test_a_session_of_another_format_is_refused_by_name(teaching, tmp_path):
    folder = SessionFolder(tmp_path)
    folder.save(teaching)
    facts = json.loads((tmp_path / "session.json").read_text())
    (tmp_path / "session.json").write_text(json.dumps({**facts, "version": 1}))
    with pytest.raises(StorageError, match=r"session of format 1.*reads 3; go on with the version"):
        folder.read()


def test_the_experiment_takes_what_was_drawn_and_leaves_out_what_it_cannot_read(
    teaching, draw, tmp_path
):
    scene, task = teaching.scene, teaching.scene.task
    teaching.show(draw("UR ↓"), "drawn")
    teaching.show(diagonal(scene), "drawn")
    SessionFolder(tmp_path).save(teaching)
    names = [episode.name for episode in read(tmp_path / DEMONSTRATIONS).episodes]
    assert names == ["UR ↓", "your motion 1"]
    recorded = read_recorded(tmp_path, task, scene.settings.caregiver, scene.body)
    assert [len(each) for each in recorded.recordings.values()] == [1]
    assert recorded.skipped == ("'your motion 1' is named by no sequence of pushing_buttons",)


def test_a_motion_of_one_s_own_has_a_name_and_is_known_from_then_on(teaching, draw):
    scene = teaching.scene
    first = teaching.show(diagonal(scene), "drawn")
    assert next(iter(first.verdict.seen)) == SOMETHING_ELSE and first.verdict.sequence is None
    assert first.entry.motion == "your motion 1" and "I call it" in first.verdict.sentence
    again = teaching.show(diagonal(scene, aside_m=0.01), "drawn")
    assert again.entry.motion == "your motion 1" and "saw before" in again.verdict.sentence
    teaching.learn(nothing)
    assert "which I have learned" in teaching.show(diagonal(scene), "drawn").verdict.sentence
    assert teaching.show(diagonal(scene)[::-1], "drawn").entry.motion == "your motion 2"
    assert teaching.show(draw("UR ↓"), "drawn").entry.motion == "UR ↓"


def test_a_robot_that_has_never_moved_claims_nothing(teaching, draw):
    for name in ("UR ↓", "LR ↑←"):
        claim = teaching.show(draw(name), "drawn").verdict.claim
        assert not claim.made and "never moved" in claim.sentence and claim.like == ""


def test_the_last_try_speaks_until_the_network_has_changed(teaching, draw, kept):
    assert teaching.show(draw("UR ↓"), "drawn").verdict.advice == "imitate"
    trial = teaching.imitate()
    assert not trial.result.good and trial.result.pushes[0].needed_mm == 5
    shown = teaching.show(draw("UR ↓"), "drawn").verdict
    assert shown.claim.tried == trial.result and shown.advice == "learn"
    assert teaching.look_back(1).verdict.claim.tried == trial.result
    assert teaching.show(draw("UR ←"), "drawn").verdict.claim.tried is None
    lesson = teaching.learn(nothing)
    assert lesson.claim == teaching.observed.verdict.claim
    assert lesson.claim.tried == lesson.result == teaching.imitate().result
    assert teaching.look_back(1).verdict.claim.tried is None
    assert teaching.notebook.entry(1).tried.result == trial.result, "the notebook keeps it"


def test_a_new_robot_leaves_the_old_one_in_a_subfolder(teaching, draw, tmp_path):
    folder = SessionFolder(tmp_path)
    teaching.show(draw("UR ←"), "drawn")
    folder.save(teaching)
    before = folder.id
    anew = folder.begin_anew("fresh", teaching)
    assert anew.notebook.entries == () and folder.id != before
    assert SessionFolder(tmp_path / "earlier-01").read().notebook.entries[0].motion == "UR ←"
    assert SessionFolder(tmp_path).read().notebook.entries == ()


@pytest.mark.slow
@pytest.mark.parametrize(("preset", "name"), [("shapes", "T ◝◡"), ("desk_arm", "UR ↓↑")])
def test_any_task_and_any_robot_can_be_taught(preset, name):
    small = ("training.epochs=5", "recognition.iterations=5")
    scene = Scene(read_settings(preset, small, quick=True), 0)
    teaching = Teaching(scene, newborn(scene, 2))
    path = scene.body.reachable(intended_way(scene.task.sequence(name), scene.task, 28))
    observed = teaching.show(path, "drawn")
    assert observed.entry.motion == name and len(observed.watched.begins) == 2
    lesson = teaching.learn(nothing)
    assert np.isfinite(lesson.errors_cm).all()
    geometry, view = Geometry(scene.body.model), View(scene.body, scene.task)
    trial = teaching.imitate()
    made = film(geometry, trial.levels, trial.performance, 10.0)
    assert made.columns["effects"].shape[1] == len(scene.task.effects)
    told = scene_message(scene, view, geometry)
    assert set(told["task"]["places"]) == set(scene.task.places) and told["robot"]["joints"]
