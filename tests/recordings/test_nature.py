"""Clocks and numbers of rows are no motion, whatever they are called and whichever format."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.recordings import Episode, Recording
from motionese.recordings.nature import judged

ROWS = np.arange(30.0)


def recording(*columns, times=None, episodes=2, units=None):
    values = np.stack([np.sin(ROWS), *columns], axis=1)
    names = ("arm", *(f"c{i}" for i in range(len(columns))))
    each = tuple(Episode.whole(str(i), values, times) for i in range(episodes))
    units = units or ("",) * len(names)
    return Recording(Path("r"), names, units, {}, None if times is not None else 20.0, each, names)


@pytest.mark.parametrize(
    ("column", "what"),
    [
        (ROWS, "rises by one from row to row"),
        (ROWS + 17, "rises by one"),
        (1.7e9 + ROWS / 20, "counting s since 1970"),
        (1.7e12 + 50 * ROWS, "counting ms since 1970"),
        (1.7e18 + 5e7 * ROWS, "counting ns since 1970"),
        (3 + ROWS / 20, "rising by the s from row to row"),
        (50 * ROWS, "rising by the ms"),
    ],
)
@pytest.mark.parametrize("times", [None, ROWS / 20 + 1e-3 * np.sin(ROWS)])
def test_what_is_no_motion_is_not_usual(column, what, times):
    found = judged(recording(column, times=times))

    assert found.usual == ("arm",)
    assert "c0" in found.channels
    assert what in found.findings[0].sentence
    assert "--channels c0" in found.findings[0].remedy


@pytest.mark.parametrize(
    ("column", "unit"),
    [
        (ROWS // 10, ""),
        (ROWS % 2, ""),
        (-ROWS, ""),
        (ROWS / 20, "rad"),
        (0.03 * ROWS, ""),
        ((1 - np.cos(ROWS / 29 * np.pi)) / 2 * 29 / 20, ""),
        (np.where(ROWS < 15, ROWS, ROWS + 1), ""),
    ],
)
def test_motions_are_left_alone(column, unit):
    found = judged(recording(column, units=("", unit)))

    assert found.usual == ("arm", "c0")
    assert not found.findings


def test_the_only_channels_are_kept():
    lone = recording(ROWS)
    lone = Recording(**{**vars(lone), "usual": ("c0",)})

    assert judged(lone) == lone


@given(st.lists(st.lists(st.floats(), max_size=14), min_size=1, max_size=3))
def test_anything_is_judged(rows):
    episodes = tuple(
        Episode.whole(str(i), np.array(r, dtype=float).reshape(-1, 1)) for i, r in enumerate(rows)
    )
    judged(Recording(Path("r"), ("x",), ("",), {}, 10.0, episodes, ("x",)))
