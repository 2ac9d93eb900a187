"""A session with a robot that knows nothing: show, imitate, learn, forget, grow, and the map."""

import numpy as np
import pytest

from motionese.body import Geometry
from motionese.experiment.checkpoint import read_learner
from motionese.teaching.frames import film
from motionese.teaching.notebook import has_settled
from motionese.teaching.saving import SessionFolder
from motionese.teaching.session import PRACTICE
from motionese.teaching.slow_map import SlowMap


def nothing(*progress):
    """Be told, and do nothing."""


def test_what_is_shown_is_noted_and_imitated(teaching, draw):
    shown = teaching.show(draw("UR ↓"), "drawn")
    assert shown.entry.number == 1 and shown.entry.motion == "UR ↓"
    assert len(shown.understood.path) == len(shown.watched.path)
    imitation = teaching.imitate()
    assert teaching.notebook.entry(1).errors_cm == (imitation.error_cm,)
    assert teaching.notebook.entries == (teaching.shown.entry,)


def test_learning_practises_and_tells_how_far_it_is(teaching, draw):
    teaching.show(draw("UR ←"), "webcam")
    told = []
    before = teaching.learner
    change = teaching.learn(lambda done, of, now: told.append((done, of)))
    epochs = teaching.scene.settings.training.epochs
    assert told == [(epochs * (i + 1), epochs * PRACTICE) for i in range(PRACTICE)]
    assert teaching.learner is not before
    errors = teaching.notebook.entry(1).errors_cm
    assert len(errors) in (PRACTICE + 1, PRACTICE + 2), "once more, where the last was not the best"
    assert (errors[0], min(errors[1:])) == (change.before_cm, change.after_cm)
    assert errors[-1] == change.after_cm
    assert teaching.notebook.curve == (change.after_cm,)
    assert {e.motion for e in teaching.learner.experiences} == {"UR ←"}
    assert teaching.imitate().error_cm == change.after_cm, "the best practice is kept"


def test_forgetting_the_last_learning_gives_the_network_back(teaching, draw, tmp_path):
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
    assert teaching.notebook.entries == () and teaching.notebook.curve == ()
    assert teaching.shown is None and teaching.forget(1, folder.learner) == ""


def test_forgetting_an_earlier_learning_ends_its_rehearsal(teaching, draw, tmp_path):
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
def test_growth_compares_the_same_imitations(teaching, draw):
    for name in ("UR ←", "UR ↓", "UR ←"):
        teaching.show(draw(name), "drawn")
    teaching.learn(nothing)
    assert teaching.can_grow and not SlowMap.possible(teaching)
    changes = teaching.grow(nothing)
    assert [c.motion for c in changes] == ["UR ←", "UR ↓"], "every motion once"
    assert not teaching.can_grow
    assert [level.name for level in teaching.learner.network.levels] == ["io", "cf", "cs"]
    assert teaching.imitate().state.shape == (teaching.learner.network.size,)
    drawn = SlowMap(teaching)
    points = teaching.scene.settings.evaluation.map_points
    assert {len(grid) for grid in drawn.grids.values()} == {points**2} and len(drawn.grids) == 5
    assert drawn.motion("UR ↓", (0.0, 1.0)).shape == (28, 3)
    assert drawn.motion("../../etc", (0.0, 1.0)) is None


def test_a_long_motion_is_followed_in_a_sliding_window(teaching, draw):
    path = draw("UR ↓↑←↓").path
    before = None
    for rows in range(5, len(path), 6):
        before = teaching.recogniser.so_far(teaching.watch(path[:rows]), before)
        assert len(before.path) == rows and np.isfinite(before.path).all()
    assert before.begin == rows - 42
    unheard = teaching.recogniser.so_far(teaching.watch(path), None)
    assert len(unheard.path) == len(path), "also when all comes at once"
    assert teaching.recogniser.so_far(teaching.watch(path[:2]), None) is None, "too early"


def test_a_film_holds_every_body_twenty_times_a_second(teaching, draw):
    teaching.show(draw("UR ↓"), "drawn")
    imitation, geometry = teaching.imitate(), Geometry()
    made = film(
        teaching.scene,
        geometry,
        teaching.learner.network,
        imitation.state,
        imitation.performance,
        84,
    )
    rows = len(imitation.performance.path)
    assert made.rate_hz == 20 and len(made) == 2 * rows - 1
    part = made.part(0, 4)
    assert len(part["poses"]) == 4 and len(part["poses"][0]) == 7 * len(geometry.bodies)
    assert len(part["io"][0]) == 6 and part["cs"] == [[], [], [], []]
    quaternions = made.columns["poses"].reshape(len(made), -1, 7)[..., 3:]
    np.testing.assert_allclose(np.linalg.norm(quaternions, axis=-1), 1, atol=1e-6)


@pytest.mark.parametrize(
    ("errors", "settled"),
    [
        ([], False),
        ([1.0, 1.0], False),
        ([9.0, 1.0, 1.0, 1.0], True),
        ([20.0, 18.0, 15.0, 9.0, 6.0, 5.0], False),
        ([6.0, 5.0, 5.0, 5.0, 5.0, 6.0], True),
    ],
)
def test_learning_settles_when_errors_are_small_or_no_longer_fall(errors, settled):
    assert has_settled(errors) is settled


def test_a_session_goes_on_from_its_folder(teaching, draw, tmp_path):
    folder = SessionFolder(tmp_path / "new")
    teaching.show(draw("UR ←"), "scripted")
    folder.began = "fresh"
    teaching.learn(nothing)
    folder.save(teaching)
    again = SessionFolder(tmp_path / "new")
    assert again.exists
    other = again.begun("")
    assert again.id == folder.id and again.began == "fresh"
    assert other.notebook.learned == teaching.notebook.learned
    assert other.notebook.entries[0].errors_cm == teaching.notebook.entries[0].errors_cm
    np.testing.assert_array_equal(other.notebook.entries[0].path, teaching.notebook.entries[0].path)
    np.testing.assert_array_equal(other.learner.network.weights, teaching.learner.network.weights)
    assert other.show(draw("UR ↓"), "drawn").entry.number == 2
    kept = {path.name for path in (tmp_path / "new").iterdir()}
    assert kept == {
        "session.json", "demonstrations.npz", "shown-0001.npz", "learner-00001.safetensors"
    }  # fmt: skip
    assert read_learner(tmp_path / "new" / "learner-00001.safetensors")[0].experiences


def test_a_new_robot_leaves_the_old_one_in_a_subfolder(teaching, draw, tmp_path):
    folder = SessionFolder(tmp_path)
    teaching.show(draw("UR ←"), "drawn")
    folder.save(teaching)
    before = folder.id
    anew = folder.begun_anew("fresh", teaching)
    assert anew.notebook.entries == () and folder.id != before
    assert SessionFolder(tmp_path / "earlier-01").begun("").notebook.entries[0].motion == "UR ←"
    assert SessionFolder(tmp_path).begun("").notebook.entries == ()
