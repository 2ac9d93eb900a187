"""What is in a recording, in numbers, whatever is wrong with it."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from motionese.recordings import Episode, Recording, survey


@pytest.fixture
def found():
    a = np.array([[0, 1], [0, 1], [0, 1], [5, 1], [10, 1], [10, 1]], float)
    b = np.array([[np.nan, 1], [2, np.inf], [4, 7]])
    seen = np.ones((3, 2), bool)
    seen[2, 1] = False
    recording = Recording(
        Path("f.csv"),
        ("arm", "odd"),
        ("rad", ""),
        {"arm": (-1.0, 11.0)},
        None,
        (
            Episode("a", np.array([0, 1, 2, 3, 6, 7.1]) / 10, a, np.ones((6, 2), bool)),
            Episode("b", np.array([0.0, 0.1, 0.2]), b, seen),
            Episode("empty", np.zeros(0), np.zeros((0, 2)), np.zeros((0, 2), bool)),
        ),
        ("arm",),
    )
    return survey(recording)


def test_episodes(found):
    a, b, empty = found.episodes

    assert (a.rows, a.duration_s, a.holes) == (6, pytest.approx(0.71), 1)
    assert (a.still_start, a.still_end, a.still) == (2 / 6, 1 / 6, 3 / 5)
    assert (b.nan, b.infinite, b.unobserved) == (1, 1, 1 / 6)
    assert (empty.rows, empty.still, empty.unobserved) == (0, 0, 0)


def test_channels(found):
    arm, odd = found.channels

    assert (arm.unit, arm.usual, arm.given) == ("rad", True, (-1.0, 11.0))
    assert (arm.low, arm.high, arm.nan, arm.infinite) == (0, 10, 1, 0)
    assert arm.mean_step == pytest.approx((5 + 5 + 2) / 6)
    assert arm.still == 3 / 6
    assert (odd.usual, odd.low, odd.high, odd.infinite) == (False, 1, 1, 1)
    assert odd.unobserved == 1 / 9


def test_rate_and_jitter(found):
    assert found.rate_hz == pytest.approx(10, rel=0.02)
    assert found.jitter == pytest.approx(0.08, abs=0.01)


def test_a_recording_without_times_or_values(recording):
    nothing = [replace(e, observed=np.zeros_like(e.observed)) for e in recording.episodes]
    numbers = survey(replace(recording, rate_hz=None, episodes=tuple(nothing)))

    assert (numbers.rate_hz, numbers.jitter) == (None, None)
    assert numbers.channels[0].low is numbers.channels[0].mean_step is None
    assert numbers.episodes[0].duration_s is None
    assert survey(recording).episodes[0].duration_s == pytest.approx(6 / 25)
