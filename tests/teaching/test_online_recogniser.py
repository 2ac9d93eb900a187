"""Recognition while the pen moves, and the arm that follows it."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.imitation import Watched
from motionese.learning import generate
from motionese.runtime.belief import NONE
from motionese.teaching.following import LAG, Following
from motionese.teaching.recogniser import Recogniser
from motionese.teaching.view import hand_seen

ROWS = 28


@pytest.fixture(scope="module")
def learner(scene, fresh):
    """A network that was never trained, with two experiences of one motion, one of another."""
    rng = np.random.default_rng(3)
    for loop, motion in ((1, "UR ↓↑"), (1, "UR ←↓"), (2, "UR ↓↑")):
        state = rng.normal(0, 3, fresh.network.size)
        values = generate(fresh.network, state, ROWS)
        fresh = fresh.experiencing(loop, motion, values, state)
    return fresh


@pytest.fixture
def recogniser(scene, learner):
    return Recogniser(scene, learner)


def watched(scene, values):
    return Watched(values, hand_seen(scene.body, values), (0,))


def test_a_motion_is_known_by_its_name_whichever_experience_of_it_is_shown(
    scene, learner, recogniser
):
    for experience in learner.experiences:
        shown = watched(scene, experience.values)
        last = recogniser.online().observe(shown)[-1]
        assert last.likeliest == experience.motion and list(last.belief)[-1] == NONE
        assert set(last.belief) == {"UR ↓↑", "UR ←↓", NONE}
        assert sum(last.belief.values()) == pytest.approx(1)
        np.testing.assert_allclose(last.path, shown.path, atol=0.01)
        assert last.next.shape == (scene.settings.caregiver.primitive_rows, 3)


def test_rows_are_looked_at_once_but_for_the_last(scene, learner, recogniser):
    values = np.concatenate([learner.experiences[0].values] * 2)  # longer than the window
    online, rows = recogniser.online(), []
    for length in (5, 5, 3, 8, len(values)):
        understood = online.observe(watched(scene, values[:length]))
        assert [len(each.path) for each in understood] == [e.result.row + 1 for e in understood]
        rows.append([each.result.row for each in understood])
    assert rows == [[0, 1, 2, 3, 4], [4], [], [4, 5, 6, 7], list(range(7, len(values)))]


def test_the_arm_tells_nothing_of_what_is_shown(scene, learner, recogniser):
    values = learner.experiences[1].values
    folded = values.copy()
    folded[:, scene.joints] = -1.0
    own, other = (recogniser.online().observe(watched(scene, v))[-1] for v in (values, folded))
    assert own.belief == other.belief
    np.testing.assert_array_equal(own.path, other.path)


def test_what_is_like_nothing_learned_is_none_of_these(scene, learner, recogniser):
    rng = np.random.default_rng(0)
    channels = scene.body.channels
    values = channels.from_unit(rng.uniform(0.1, 0.9, (12, len(channels))))
    last = recogniser.online().observe(watched(scene, values))[-1]
    assert last.likeliest == NONE and last.belief[NONE] > 0.9


def test_without_experiences_there_is_nothing_to_recognise(scene, fresh):
    assert Recogniser(scene, fresh).online() is None


def test_the_arm_is_some_rows_behind_the_pen(scene, learner, recogniser):
    understood = recogniser.online().observe(watched(scene, learner.experiences[0].values))
    following = Following(scene, "UR", understood[0])
    for each in understood:
        following.follow(each)
        following.follow(each)  # a row that is corrected takes no time
    following.catch_up()
    done = following.performance
    assert len(done.path) == len(done.activity) == ROWS + LAG - 1
    low, high = scene.body.command_range
    posture, *others = done.commanded
    np.testing.assert_array_equal(posture, np.clip(scene.postures["UR"], low, high))
    arm = [each.result.path[-LAG, scene.joints] for each in understood[1:]]
    arm += [understood[-1].result.path[-1, scene.joints]]
    np.testing.assert_array_equal(others, np.clip(arm, low, high))
    assert np.ptp(done.sensed[:, scene.joints], axis=0).max() > 0.05, "the arm has moved [rad]"


def test_the_arm_stays_where_it_is_told_while_nothing_is_known(scene, learner, recogniser):
    first, *others = recogniser.online().observe(watched(scene, learner.experiences[0].values))
    following = Following(scene, "UR", first)
    for each in others:
        lost = {**dict.fromkeys(each.belief, 0.3), NONE: 0.4}
        known = each.result.row < ROWS // 2
        following.follow(each if known else replace(each, belief=lost))
    following.catch_up()
    commanded = following.performance.commanded
    assert (commanded[ROWS // 2 - 1 :] == commanded[ROWS // 2 - 1]).all()
    assert not (commanded[0] == commanded[ROWS // 2 - 1]).all()
