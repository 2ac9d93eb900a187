"""A hand out of view: what was not observed is left out, and the robot acts on what it predicts."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.experiment import read_settings
from motionese.imitation import Scene, newborn
from motionese.imitation.measures import seen_error_cm
from motionese.imitation.performance import perform
from motionese.task import PUSHING_BUTTONS

PAIR = PUSHING_BUTTONS.sequence("UR ↓↑")
ROWS = 12
UNSEEN = slice(4, 8)
"""Senses of a trial in which the hand is out of view."""


@pytest.fixture(scope="module")
def scene():
    return Scene(read_settings(overrides=["network.levels.cf.size=8"], quick=True), seed=3)


def performed(scene, monkeypatch, unseen, feedback):
    body, counted = scene.body, [0]

    def sense():
        values = type(body).sense(body)
        if unseen and counted[0] in range(ROWS)[UNSEEN]:
            values[-2:] = np.nan
        counted[0] += 1
        return values

    monkeypatch.setattr(body, "sense", sense)
    network = newborn(scene, 2).network
    acting = scene.settings.imitation.model_copy(update={"feedback": feedback})
    rng, posture = np.random.default_rng(0), scene.postures[PAIR.start]
    done = perform(body, network, np.zeros(network.size), posture, ROWS, acting, rng)
    monkeypatch.undo()
    return done


def test_without_feedback_it_acts_as_if_it_had_seen(scene, monkeypatch):
    seen, unseen = (performed(scene, monkeypatch, hidden, 0.0) for hidden in (False, True))
    np.testing.assert_array_equal(seen.commanded, unseen.commanded)
    np.testing.assert_array_equal(seen.predicted, unseen.predicted)
    gone = np.isnan(unseen.sensed)
    assert gone[UNSEEN, -2:].all() and gone.sum() == 2 * 4


def test_with_feedback_its_own_prediction_stands_in(scene, monkeypatch):
    seen, unseen = (performed(scene, monkeypatch, hidden, 0.8) for hidden in (False, True))
    assert np.isfinite(unseen.commanded).all() and np.isfinite(unseen.predicted).all()
    first = UNSEEN.start + 1  # the first prediction from a row that was not seen
    np.testing.assert_array_equal(seen.predicted[:first], unseen.predicted[:first])
    assert (seen.predicted[first] != unseen.predicted[first]).any()


def test_what_was_not_seen_is_neither_recognised_nor_learned(scene, monkeypatch):
    done = performed(scene, monkeypatch, True, 0.0)
    shown = scene.to_recognise([done.sensed])
    assert not shown.observed[0][UNSEEN, -2:].any() and shown.observed[0][8:, -2:].all()
    learner = newborn(scene, 2)
    state = np.zeros(learner.network.size)
    learner = learner.experiencing(1, PAIR.name, done.experience(True), state)
    motions = learner.motions(scene.body.rate_hz)
    np.testing.assert_array_equal(motions.observed[0], np.isfinite(done.sensed))
    assert np.isfinite(np.asarray(motions.batch().sensed)).all()


def test_rows_out_of_view_do_not_count_as_errors(scene, monkeypatch):
    done = performed(scene, monkeypatch, True, 0.0)
    rows = np.isfinite(done.sensed).all(axis=1)
    arrays = (done.sensed, done.predicted, done.path)
    expected = seen_error_cm(scene.body, *(a[rows] for a in arrays))
    assert seen_error_cm(scene.body, *arrays) == expected > 0
    none = replace(done, sensed=np.full_like(done.sensed, np.nan))
    assert np.isnan(seen_error_cm(scene.body, none.sensed, done.predicted, done.path))
