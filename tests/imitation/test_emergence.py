"""What has emerged in a level: on networks whose weights say what it should be."""

import numpy as np
import pytest

from motionese.experiment import read_settings
from motionese.imitation import Scene, babbled, newborn, share_emerged
from motionese.imitation.emergence import _between, _clear, _over_map
from motionese.imitation.keys import key_for
from motionese.imitation.roles.recognised import RecognisedDemonstration, RecognisedLesson
from motionese.network import MTRNN, Level
from motionese.task import PUSHING_BUTTONS

SMALL = [
    "network.levels.cf.size=8",
    "babbling.epochs=5",
    "recognition.iterations=5",
    "evaluation.map_points=3",
]
LESSON = PUSHING_BUTTONS.lesson("branching")


@pytest.fixture(scope="module")
def scene():
    return Scene(read_settings(overrides=SMALL, quick=True), seed=3)


@pytest.mark.slow
def test_it_is_a_share_that_depends_on_learner_and_loop_alone(scene):
    learner = babbled(scene, newborn(scene, 3))
    shares = {level: share_emerged(scene, learner, LESSON, level, 4) for level in ("cf", "cs")}
    assert all(0 <= share <= 1 for share in shares.values())
    assert shares == {level: share_emerged(scene, learner, LESSON, level, 4) for level in shares}


def lesson(network, ways):
    """Demonstrations that go straight the ways [rad], of unit extent, by states that point so."""
    rows = np.linspace(0, 1, 11)[:, None]
    of = []
    for sequence, way in zip(PUSHING_BUTTONS.sequences(1), ways, strict=False):
        to = np.array([-np.cos(way), np.sin(way)])
        state = np.zeros(network.size)
        state[network.units("cf")] = 3 * to
        of.append(RecognisedDemonstration(sequence, 1, state, np.zeros(2), (0,), 0.1 * rows * to))
    return RecognisedLesson(network, lambda values: values, tuple(of), {})


@pytest.fixture
def network(monkeypatch):
    network = MTRNN.draw([Level(2, 2.0), Level(2, 5.0), Level(2, 70.0)], key=key_for(0))

    def follow(categorical, by="cf"):
        def generate(_, states, rows, first):
            to = states[:, network.units(by)]
            if categorical:  # the nearest axis
                to = np.where(abs(to) == abs(to).max(1, keepdims=True), np.sign(to), 0.0)
            else:
                to = to / 3
            return 0.1 * np.linspace(0, 1, rows)[:, None] * to[:, None]

        monkeypatch.setattr("motionese.imitation.emergence.generate", generate)

    return network, follow


def test_primitives_are_clear_where_they_are_categories_and_not_where_they_blend(network):
    network, follow = network
    alone = lesson(network, (0.0, np.pi / 2, np.pi))
    points = _between(alone, "cf")
    assert len(points) == 3 * 2 * 5
    follow(categorical=True)
    assert _clear(alone, points) == pytest.approx(1.0)
    follow(categorical=False)
    assert 0.2 < _clear(alone, points) < 0.8
    assert _clear(alone, []) == 0.0


def test_a_level_above_leaves_strokes_alone_or_takes_their_place(network, scene):
    network, follow = network
    alone = lesson(network, (0.0, np.pi / 2, np.pi))
    points = _over_map(scene, alone, "cs")
    assert len(points) == 3 * 9
    assert all(np.array_equal(s[2:4], own.initial_state[2:4]) for own, s in points)
    follow(categorical=True)
    assert _clear(alone, points) == 1.0
    follow(categorical=True, by="cs")
    assert _clear(alone, points) < 0.5
