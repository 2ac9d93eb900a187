"""How the caregiver moves: smooth strokes between corners, rests, variability from a generator."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.body import CORNERS, projected
from motionese.caregiver import (
    PUSHING_BUTTONS,
    Demonstrating,
    RecordedCaregiver,
    ScriptedCaregiver,
)
from motionese.errors import TaskError
from motionese.minimum_jerk import minimum_jerk

MANNER = Demonstrating(stroke_steps=12, rest_steps=2, variability_mm=3.0, persistence=0.9)
PAIR = PUSHING_BUTTONS.motion("UR ↓↑")


def test_minimum_jerk_starts_and_ends_at_rest():
    share = minimum_jerk(np.linspace(0, 1, 1001))
    speed, acceleration = np.gradient(share, 1e-3), np.gradient(np.gradient(share, 1e-3), 1e-3)
    assert share[0] == 0 and share[-1] == 1
    assert np.abs(speed[[0, -1]]).max() < 1e-3
    assert np.abs(acceleration[[2, -3]]).max() < 0.2
    assert speed.max() == pytest.approx(1.875, abs=1e-3)


@pytest.mark.parametrize("motion", PUSHING_BUTTONS.sequences(3), ids=lambda m: m.name)
def test_the_intended_path_passes_the_corners_and_rests_there(motion):
    path = ScriptedCaregiver(MANNER).intended(motion)
    assert path.shape == (MANNER.rows(motion), 3) == (42, 3)
    np.testing.assert_allclose(path[0], CORNERS[motion.start], atol=1e-9)
    for place, corner in enumerate(motion.corners[1:], start=1):
        for row in range(14 * place - 2, min(14 * place + 1, len(path))):
            np.testing.assert_allclose(path[row], CORNERS[corner], atol=1e-9)


def test_the_intended_path_lies_where_the_hand_can_be():
    path = ScriptedCaregiver(MANNER).intended(PAIR)
    np.testing.assert_allclose(projected(path), path, atol=1e-9)
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    assert 20 < 100 * steps[:12].sum() < 26


def test_variability_has_the_given_size_and_persistence():
    caregiver = ScriptedCaregiver(MANNER)
    rng = np.random.default_rng(0)
    off = np.array(
        [caregiver.demonstrate(PAIR, rng) - caregiver.intended(PAIR) for _ in range(400)]
    )
    assert 1000 * off.std() == pytest.approx(3.0, rel=0.05)
    assert np.allclose(1000 * off.std(axis=(0, 2)), 3.0, rtol=0.15)
    correlation = (off[:, 1:] * off[:, :-1]).mean() / (off**2).mean()
    assert correlation == pytest.approx(0.9, abs=0.02)


def test_the_same_generator_gives_the_same_demonstration():
    caregiver = ScriptedCaregiver(MANNER)
    one, same, other = (
        caregiver.demonstrate(PAIR, np.random.default_rng(seed)) for seed in (1, 1, 2)
    )
    assert np.array_equal(one, same)
    assert not np.allclose(one, other)


def test_without_variability_it_shows_what_it_intends():
    caregiver = ScriptedCaregiver(MANNER.model_copy(update={"variability_mm": 0.0}))
    shown = caregiver.demonstrate(PAIR, np.random.default_rng(0))
    assert np.array_equal(shown, caregiver.intended(PAIR))


@given(stroke=st.integers(2, 30), rest=st.integers(0, 10))
def test_rows_are_those_of_strokes_and_rests(stroke, rest):
    manner = Demonstrating(
        stroke_steps=stroke, rest_steps=rest, variability_mm=1.0, persistence=0.5
    )
    path = ScriptedCaregiver(manner).demonstrate(PAIR, np.random.default_rng(0))
    assert len(path) == manner.rows(PAIR) == 2 * (stroke + rest)


def test_unreachable_and_unknown_corners_are_told():
    far = MANNER.model_copy(update={"corners": {"UR": (2.0, 0.0, 1.0)}})
    with pytest.raises(TaskError, match=r"corner UR .* cm "):
        ScriptedCaregiver(far)
    unknown = MANNER.model_copy(update={"corners": {"UX": (0.5, 0.0, 1.0)}})
    with pytest.raises(TaskError, match="unknown corner 'UX'; did you mean 'U"):
        ScriptedCaregiver(unknown)


def test_recordings_stand_in_for_the_scripted_caregiver():
    paths = [np.full((20, 3), float(i)) for i in range(3)]
    caregiver = RecordedCaregiver({"UR ↓↑": paths})
    rng = np.random.default_rng(0)
    shown = {float(caregiver.demonstrate(PAIR, rng)[0, 0]) for _ in range(50)}
    assert shown == {0.0, 1.0, 2.0}
    with pytest.raises(TaskError, match="unknown recorded motion 'UR ↓'"):
        caregiver.demonstrate(PUSHING_BUTTONS.motion("UR ↓"), rng)
