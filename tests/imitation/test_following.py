"""The robot follows a demonstration while it is shown, and notices when it turns."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.caregiver import Demonstration
from motionese.errors import TaskError
from motionese.experiment import read_settings
from motionese.imitation import (
    Learner,
    Scene,
    follow,
    followed,
    imitate,
    newborn,
    recognised_while_shown,
    sequence_of,
    switched,
)
from motionese.imitation.switching import primitives_of
from motionese.runtime import NONE
from motionese.task import PUSHING_BUTTONS

PAIRS = PUSHING_BUTTONS.lesson("taught pairs")
SMALL = [
    "network.levels.cf.size=20",
    "recognition.optimiser=least_squares",
    "evaluation.online.lags=[0, 3]",
    "evaluation.online.window=15",
]


@pytest.fixture(scope="module")
def scene():
    return Scene(read_settings(overrides=SMALL, quick=True), seed=3)


@pytest.fixture(scope="module")
def learner(scene):
    """A robot that has learned what it saw of two pairs, its own arm at rest."""
    learner = newborn(scene, 2)
    settings = scene.settings.training.model_copy(update={"epochs": 2000, "noise": {}})
    for sequence in PAIRS:
        watched = scene.show(sequence, "learned")
        values, state = scene.as_own(sequence.start, watched), np.zeros(learner.network.size)
        begins = watched.begins
        learner = learner.experiencing(1, sequence.name, values, state, begins=begins)
    return learner.trained(settings, scene.body.rate_hz)[0]


def test_what_is_shown_is_known_row_by_row(scene, learner):
    watched = scene.show(PAIRS[0], "learned")
    results = recognised_while_shown(scene, learner, PAIRS[0].start, watched)
    assert [r.row for r in results] == list(range(len(watched.path)))
    # Late in a motion its last rows alone may be those of another one.
    believed = [r.learned[0] for r in results if r.learned]
    assert believed.count(f"{PAIRS[0].name} (loop 1)") > len(results) / 2
    assert max(len(r.path) for r in results) == 15
    # The arm's own joints are known in the first row alone.
    assert results[5].values == 5 * 4


def test_it_commands_what_it_knows_of_the_row_that_is_due(scene, learner):
    watched = scene.show(PAIRS[0], "learned")
    results = recognised_while_shown(scene, learner, PAIRS[0].start, watched)
    rows, lag = len(results), 3
    done = follow(scene, PAIRS[0], results, lag, "test")

    assert len(done.path) == rows + lag
    start = np.clip(scene.postures[PAIRS[0].start], *scene.body.command_range)
    np.testing.assert_array_equal(done.commanded[: lag + 1], np.tile(start, (lag + 1, 1)))
    for time in (lag + 2, 12, rows + lag - 1):
        known = results[min(time - 1, rows - 1)]
        due = np.clip(known.expected(time - lag)[scene.joints], *scene.body.command_range)
        np.testing.assert_array_equal(done.commanded[time], due)


def test_a_row_per_sequence_and_lag(scene, learner):
    imitated = imitate(scene, learner, PAIRS[:2], scene.settings.recognition, "online")
    rows = followed(scene, learner, imitated)
    assert [(row["motion"], row["lag"]) for row in rows] == [
        (pair.name, lag) for pair in PAIRS[:2] for lag in (0, 3)
    ]
    assert all(np.isfinite(row["imitation_error_cm"]) for row in rows)
    assert rows == followed(scene, learner, imitated)


def test_turns_are_noticed_and_are_the_same_again(scene, learner):
    turns = switched(scene, learner, PAIRS, 4)
    assert len(turns) == 4
    assert [t.measures() for t in turns] == [
        t.measures() for t in switched(scene, learner, PAIRS, 4)
    ]
    for turn in turns:
        beliefs = turn.belief()
        assert beliefs.keys() == {*(pair.name for pair in PAIRS), NONE}
        np.testing.assert_allclose(sum(beliefs.values()), 1, atol=1e-6)
        assert turn.first != turn.second and 0 < turn.row < len(turn.results)
        assert turn.kept()["switch"][0] == turn.row
    assert sum(t.steps is not None and t.steps <= 8 for t in turns) >= 3


def test_a_turn_is_noticed_by_the_rows_in_which_motions_were_learned(scene, learner):
    later = [replace(e, begins=(0, 999)) for e in learner.experiences]  # no second stroke in sight
    turns = switched(scene, learner, PAIRS, 4)
    untold = switched(scene, replace(learner, experiences=tuple(later)), PAIRS, 4)
    assert [turn.row for turn in untold] == [turn.row for turn in turns]
    assert [turn.steps for turn in untold] != [turn.steps for turn in turns]


def test_without_another_sequence_nothing_turns(scene, learner):
    assert switched(scene, learner, PAIRS[:1], 3) == []
    apart = [PUSHING_BUTTONS.sequence("LR ↑"), PUSHING_BUTTONS.sequence("LL ↑")]
    assert switched(scene, learner, apart, 3) == []


def test_a_demonstration_turns_into_another_where_it_is_told_to():
    one = Demonstration(np.linspace([0.0, 0, 0], [1.0, 0, 0], 11), (0, 5))
    other = Demonstration(np.linspace([0.0, 1, 0], [0.0, 2, 0], 9), (0, 4))
    turned = one.turning(6, other, 3, over=2)
    np.testing.assert_array_equal(turned.path[:6], one.path[:6])
    np.testing.assert_allclose(turned.path[6], one.path[6])
    np.testing.assert_allclose(turned.path[8:], other.path[5:])
    assert turned.begins == (0, 5, 7)
    assert len(turned.path) == 6 + 6


def test_primitives_and_names_of_rows():
    pair = PAIRS[0]
    names = [each.name for each in pair.primitives]
    assert primitives_of(pair, (0, 3), 5) == [names[0]] * 3 + [names[1]] * 2
    assert sequence_of(f"{pair.name} (loop 12)") == pair.name
    with pytest.raises(TaskError):
        Demonstration(np.zeros((3, 3)), ())


def test_the_repertoire_combines_the_levels_of_what_was_learned_last(scene):
    learner = Learner(newborn(scene, 3).network)
    rng = np.random.default_rng(0)
    states = {}
    for loop, name in ((1, "UR ↓"), (1, "UL ↓"), (2, "UR ↓")):
        states[loop, name] = rng.normal(size=learner.network.size)
        learner = learner.experiencing(loop, name, np.zeros((4, 6)), states[loop, name])
    cf, cs = learner.network.units("cf"), learner.network.units("cs")
    latest = [states[2, "UR ↓"], states[1, "UL ↓"]]

    found = learner.repertoire()

    assert found.shape == (4, learner.network.size)
    np.testing.assert_array_equal(learner.memory.initial_states, found)
    assert np.isnan(learner.memory.errors).all(), "how well a combination was learned is not known"
    pairs = {(tuple(row[cf]), tuple(row[cs])) for row in found}
    assert pairs == {(tuple(a[cf]), tuple(b[cs])) for a in latest for b in latest}
