"""How the caregiver moves: smooth strokes between places, rests, variability from a generator."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.body import open_body
from motionese.body.actroid import ActroidSettings
from motionese.caregiver import Demonstration, Manner, ScriptedCaregiver
from motionese.errors import TaskError
from motionese.minimum_jerk import minimum_jerk
from motionese.task import PUSHING_BUTTONS, SHAPES

MANNER = Manner(stroke_steps=12, rest_steps=2, variability_mm=3.0, persistence=0.9)
PAIR = PUSHING_BUTTONS.sequence("UR ↓↑")


@pytest.fixture(scope="module")
def body():
    return open_body(ActroidSettings(), PUSHING_BUTTONS)


@pytest.fixture(scope="module")
def caregiver(body):
    return ScriptedCaregiver(PUSHING_BUTTONS, MANNER, body)


def test_minimum_jerk_starts_and_ends_at_rest():
    share = minimum_jerk(np.linspace(0, 1, 1001))
    speed, acceleration = np.gradient(share, 1e-3), np.gradient(np.gradient(share, 1e-3), 1e-3)
    assert share[0] == 0 and share[-1] == 1
    assert np.abs(speed[[0, -1]]).max() < 1e-3
    assert np.abs(acceleration[[2, -3]]).max() < 0.2
    assert speed.max() == pytest.approx(1.875, abs=1e-3)


@pytest.mark.parametrize("sequence", PUSHING_BUTTONS.sequences(3), ids=lambda s: s.name)
def test_the_intended_path_passes_the_places_and_rests_there(caregiver, sequence):
    path = caregiver.intended(sequence)
    assert path.shape == (MANNER.rows(sequence), 3) == (42, 3)
    assert MANNER.begins(sequence) == (0, 14, 28, 42)
    np.testing.assert_allclose(path[0], PUSHING_BUTTONS.position(sequence.start), atol=1e-9)
    for number, place in enumerate(sequence.places[1:], start=1):
        for row in range(14 * number - 2, min(14 * number + 1, len(path))):
            np.testing.assert_allclose(path[row], PUSHING_BUTTONS.position(place), atol=1e-9)


def test_a_primitive_s_own_duration_lengthens_its_stroke():
    slow = MANNER.begins(_lasting(PAIR, 1.5))
    assert slow == (0, 20, 34)
    with pytest.raises(TaskError, match="must begin at rising rows"):
        Demonstration(np.zeros((10, 3)), (0, 10))


def _lasting(sequence, duration):
    first, *others = sequence.primitives
    return replace(sequence, primitives=(replace(first, duration=duration), *others))


def test_the_intended_path_lies_where_the_hand_can_be(caregiver, body):
    path = caregiver.intended(PAIR)
    np.testing.assert_allclose(body.reachable(path), path, atol=1e-9)
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    assert 20 < 100 * steps[:12].sum() < 26


def test_arcs_are_shown_as_arcs():
    body = open_body(ActroidSettings(), SHAPES)
    arc = SHAPES.sequence("T ◝")
    path = ScriptedCaregiver(SHAPES, MANNER, body).intended(arc)
    chord = np.linalg.norm(SHAPES.position("LR") - SHAPES.position("T"))
    assert np.linalg.norm(np.diff(path, axis=0), axis=1).sum() > 1.15 * chord


def test_variability_has_the_given_size_and_persistence(caregiver):
    rng = np.random.default_rng(0)
    off = np.array(
        [caregiver.demonstrate(PAIR, rng).path - caregiver.intended(PAIR) for _ in range(400)]
    )
    assert 1000 * off.std() == pytest.approx(3.0, rel=0.05)
    assert np.allclose(1000 * off.std(axis=(0, 2)), 3.0, rtol=0.15)
    correlation = (off[:, 1:] * off[:, :-1]).mean() / (off**2).mean()
    assert correlation == pytest.approx(0.9, abs=0.02)


def test_without_variability_it_shows_what_it_intends(body):
    still = MANNER.model_copy(update={"variability_mm": 0.0})
    caregiver = ScriptedCaregiver(PUSHING_BUTTONS, still, body)
    shown = caregiver.demonstrate(PAIR, np.random.default_rng(0))
    assert np.array_equal(shown.path, caregiver.intended(PAIR))


@given(stroke=st.integers(2, 30), rest=st.integers(0, 10))
def test_rows_are_those_of_strokes_and_rests(body, stroke, rest):
    manner = Manner(stroke_steps=stroke, rest_steps=rest, variability_mm=1.0, persistence=0.5)
    shown = ScriptedCaregiver(PUSHING_BUTTONS, manner, body).demonstrate(
        PAIR, np.random.default_rng(0)
    )
    assert len(shown.path) == manner.rows(PAIR) == 2 * (stroke + rest)
    assert shown.begins == (0, stroke + rest)
