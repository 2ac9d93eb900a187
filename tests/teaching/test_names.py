"""Motions of one's own are known by the name that a person gives them."""

import numpy as np
import pytest

from motionese.caregiver import lasting
from motionese.recordings import read
from motionese.teaching.names import LONGEST, NamingError, rename
from motionese.teaching.session_folder import SessionFolder


def nothing(*progress):
    """Be told, and do nothing."""


@pytest.fixture
def diagonal(scene):
    """The way from one corner to the opposite one, from either end."""
    ends = [scene.task.position(name) for name in ("UR", "LL")]
    path = scene.body.reachable(lasting(np.stack(ends), 20))
    return path, path[::-1].copy()


@pytest.mark.slow
def test_all_that_is_known_of_a_motion_follows_its_name(teaching, diagonal, kept, tmp_path):
    folder = SessionFolder(tmp_path)
    teaching.show(diagonal[0], "drawn")
    teaching.learn(nothing)
    folder.save(teaching)
    result = teaching.standing.results["your motion 1"]
    weights = np.asarray(teaching.learner.network.weights)
    rename(teaching, "your motion 1", "  big   wave ")
    observed = teaching.observed
    assert observed.entry.motion == observed.verdict.motion == "big wave"
    assert next(iter(observed.verdict.seen)) == "big wave"
    assert "I saw big wave" in observed.verdict.sentence
    assert observed.verdict.claim.tried == result, "what its last try came to is still known"
    assert [e.motion for e in teaching.notebook.entries] == ["big wave"]
    assert [*teaching.notebook.curves] == ["big wave"]
    assert {e.motion for e in teaching.learner.experiences} == {"big wave"}
    np.testing.assert_array_equal(teaching.learner.network.weights, weights)
    assert teaching.show(diagonal[0], "drawn").entry.motion == "big wave", "it is recognised"
    folder.save(teaching)
    again = SessionFolder(tmp_path).read()
    assert [e.motion for e in again.notebook.entries] == ["big wave"] * 2
    assert {e.motion for e in again.learner.experiences} == {"big wave"}
    assert read(tmp_path / "demonstrations.npz").episodes[0].name == "big wave"


@pytest.mark.slow
def test_a_robot_that_is_returned_to_knows_it_by_its_new_name(
    teaching, draw, diagonal, kept, tmp_path
):
    folder = SessionFolder(tmp_path)
    teaching.show(diagonal[0], "drawn")
    teaching.learn(nothing)
    folder.save(teaching)
    teaching.show(draw("UR ←"), "drawn")
    teaching.learn(nothing)
    folder.save(teaching)
    for before, name in (("your motion 1", "wave"), ("wave", "big wave")):
        rename(teaching, before, name)
    folder.save(teaching)
    teaching.forget(2, folder.learner)
    assert {e.motion for e in teaching.learner.experiences} == {"big wave"}


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("", "letters, digits and spaces"),
        ("<b>", "letters, digits and spaces"),
        ("a" * (LONGEST + 1), f"at most {LONGEST}"),
        ("ur wave", "The task's own motions"),
        ("slide", "The task's own motions"),
        ("Something else", "something else"),
        ("none of these", "something else"),
        ("Your Motion 2", "something else"),
    ],
)
def test_what_a_motion_cannot_be_called_is_said_in_a_sentence(teaching, diagonal, name, said):
    for path in diagonal:
        teaching.show(path, "drawn")
    before = teaching.standing
    with pytest.raises(NamingError, match=said) as refused:
        rename(teaching, "your motion 1", name)
    assert str(refused.value).count(".") == 1
    assert teaching.standing is before


def test_a_name_that_a_motion_had_is_given_to_no_other(teaching, draw, diagonal):
    teaching.show(diagonal[0], "drawn")
    rename(teaching, "your motion 1", "wave")
    assert teaching.show(diagonal[1], "drawn").entry.motion == "your motion 2"
    rename(teaching, "your motion 2", "sweep")
    for taken in ("Wave", "your motion 1"):
        with pytest.raises(NamingError, match="something else"):
            rename(teaching, "sweep", taken)
    rename(teaching, "sweep", "your motion 2")
    assert teaching.observed.entry.motion == "your motion 2", "its own it may have again"
    teaching.show(draw("UR ↓"), "drawn")
    for motion in ("UR ↓", "babbling", "no such"):
        with pytest.raises(NamingError, match="of your own"):
            rename(teaching, motion, "mine")
