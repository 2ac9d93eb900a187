"""Who shares a level's initial states follows from which level was on top when, and from nothing
else."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.errors import SettingError
from motionese.experiment import read_settings
from motionese.imitation import Learner, Scene, key_for, newborn
from motionese.imitation.learner import read_learner, write_learner
from motionese.imitation.repertoire import Element, element_called, element_seen, first_primitive

SHARED = ["training.shared.cf=repertoire", "network.levels.cf.size=8"]
PRIMITIVES, PAIRS = ("UR ↓", "LR ↑", "UR ←"), ("UR ↓↑", "LR ↑←", "LR ↑↓")


@pytest.fixture(scope="module")
def scene():
    return Scene(read_settings(overrides=SHARED, quick=True), seed=3)


def taught(scene, learner, loop, motions, epochs=3):
    """Let a learner learn motions of random values, as a loop does."""
    rng = np.random.default_rng(loop)
    for motion in motions:
        values = scene.body.channels.from_unit(rng.uniform(0.2, 0.8, (8, 6)))
        state = rng.normal(size=learner.network.size)
        learner = learner.experiencing(loop, motion, values, state, learner.begins_with(motion))
    settings = scene.settings.training.model_copy(update={"epochs": epochs})
    return learner.trained(settings, scene.body.rate_hz, key=key_for(3, "t"))[0]


def sharing(learner, level):
    """Which experiences have which of the different initial states of a level."""
    states = [tuple(e.initial_state[learner.network.units(level)]) for e in learner.experiences]
    kinds = list(dict.fromkeys(states))
    return [kinds.index(state) for state in states]


def grown(scene, learner):
    return learner.grown(scene.settings.network, key_for(3, "network"))


def test_motions_share_what_was_learned_while_the_level_was_on_top(scene):
    """TD/MD: Cf's repertoire are the primitives, each experience having its own while it is top."""
    learner = taught(scene, newborn(scene, 2), 1, [*PRIMITIVES, "UR ↓"])
    assert sharing(learner, "cf") == [0, 1, 2, 3]

    learner = taught(scene, grown(scene, learner), 2, PAIRS)

    assert sharing(learner, "cf") == [0, 1, 2, 0, 0, 1, 1]
    assert sharing(learner, "cs") == list(range(7))
    known = {e.motion: e for e in learner.repertoire_of("cf")}
    assert set(known) == set(PRIMITIVES)
    cf = learner.network.units("cf")
    np.testing.assert_array_equal(
        known["UR ↓"].initial_state[cf], learner.experiences[0].initial_state[cf]
    )
    starts = learner.repertoire()
    assert len(starts) == 3 * 6, "Cf of three elements, Cs of the latest of six motions"


def test_whole_pairs_are_the_repertoire_where_they_were_taught_first(scene):
    """TND/MD: a motion shares with its own repetitions alone."""
    learner = grown(scene, taught(scene, newborn(scene, 2), 1, PAIRS))
    learner = taught(scene, learner, 2, [*PAIRS, "UL ↓↑"])
    assert sharing(learner, "cf") == [0, 1, 2, 0, 1, 2, 3]


def test_a_level_that_was_never_on_top_has_one_for_all(scene):
    """MND, whatever is taught."""
    learner = taught(scene, newborn(scene, 3), 1, PRIMITIVES)
    learner = taught(scene, learner, 2, PAIRS)
    assert sharing(learner, "cf") == [0] * 6
    assert len(set(sharing(learner, "cs"))) == 6
    assert learner.elements == ()
    assert len(learner.repertoire()) == 6


def test_sharing_by_the_first_primitive_does_not_ask_which_level_is_on_top(scene):
    settings = scene.settings.training.model_copy(update={"shared": {"cf": "first primitive"}})
    scene = Scene(scene.settings.model_copy(update={"training": settings}), seed=3)
    learner = taught(scene, newborn(scene, 2), 1, PAIRS)
    assert sharing(learner, "cf") == [0, 1, 1]
    assert [first_primitive(motion) for motion in PAIRS] == ["UR ↓", "LR ↑", "LR ↑"]


def test_nobody_shares_where_it_is_not_asked_for(scene):
    settings = scene.settings.training.model_copy(update={"shared": {"cf": "none"}})
    scene = Scene(scene.settings.model_copy(update={"training": settings}), seed=3)
    learner = grown(scene, taught(scene, newborn(scene, 2), 1, PRIMITIVES))
    assert sharing(taught(scene, learner, 2, PAIRS), "cf") == list(range(6))
    assert learner.elements == ()


def test_a_learner_is_read_as_it_was_written(scene, tmp_path):
    learner = grown(scene, taught(scene, newborn(scene, 2), 1, PRIMITIVES))
    learner = taught(scene, learner, 2, PAIRS)
    write_learner(tmp_path / "one", learner, 10.0, {"loop": 2})

    read, facts = read_learner(tmp_path / "one")

    assert facts == {"loop": 2}
    assert [e.begins_with for e in read.experiences] == [e.begins_with for e in learner.experiences]
    for one, other in zip(read.elements, learner.elements, strict=True):
        assert (one.level, one.motion) == (other.level, other.motion)
        np.testing.assert_array_equal(one.values, other.values)
        np.testing.assert_array_equal(one.initial_state, other.initial_state)
    again = taught(scene, read, 3, PAIRS)
    for one, other in zip(
        again.experiences, taught(scene, learner, 3, PAIRS).experiences, strict=True
    ):
        np.testing.assert_array_equal(one.initial_state, other.initial_state)


def element(motion, values):
    return Element("cf", motion, np.asarray(values, dtype=float), np.zeros(3))


def test_an_element_is_told_by_its_name_or_by_what_was_seen():
    elements = [
        element("UR ↓", [[0, 0], [1, 0], [2, 0]]),
        element("UR ←", [[0, 0], [0, 1], [0, 2]]),
        element("UR ←↓", [[0, 0], [0, 1], [0, 2], [0, 0]]),
    ]
    assert element_called(elements, "UR ←↓↑") == "UR ←↓"
    assert element_called(elements, "UR ↓↑") == "UR ↓"
    assert element_called(elements, "LR ↑") == "LR ↑", "it begins with nothing that is known"
    shown = np.array([[0.1, np.nan], [1.2, np.nan], [1.9, np.nan], [5.0, np.nan]])
    assert element_seen(elements, shown, np.ones(2)) == "UR ↓"
    assert element_seen(elements, shown[:, ::-1], np.ones(2)) == "UR ←"
    assert element_seen(elements[:1], shown[:2], np.ones(2)) == "UR ↓", "shorter than the element"


def test_a_learner_goes_by_what_it_saw_where_it_is_told_to(scene):
    learner = replace(
        Learner(newborn(scene, 3).network), elements=(element("UR ↓", np.zeros((4, 6))),)
    )
    seen = np.full((9, 6), np.nan)
    seen[:, 2:] = 0.01
    assert learner.begins_with("LR ↑←") == {"cf": "LR ↑←"}
    assert learner.begins_with("LR ↑←", seen) == {"cf": "UR ↓"}


@pytest.mark.parametrize(
    ("level", "told"),
    [
        ("cs", "cs is the top level, whose initial states belong to single motions.* those of cf"),
        ("css", "unknown level in training.shared 'css'"),
        ("io", "unknown level in training.shared 'io'"),
    ],
)
def test_a_level_that_cannot_be_shared_is_told(level, told):
    with pytest.raises(SettingError, match=told):
        read_settings(overrides=[f"training.shared.{level}=repertoire"])


def test_another_sharing_or_grouping_is_told():
    with pytest.raises(SettingError, match=r"training\.shared\.cf = 'all'.*'repertoire'"):
        read_settings(overrides=["training.shared.cf=all"])
    with pytest.raises(SettingError, match=r"training\.grouping = 'guess'"):
        read_settings(overrides=["training.grouping=guess"])
