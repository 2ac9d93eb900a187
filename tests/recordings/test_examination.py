"""Steps that no arm makes are found where they are, and nowhere else."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.errors import ChannelError, RecordingError
from motionese.minimum_jerk import minimum_jerk
from motionese.recordings import Episode, Recording, choose, examined, prepare

SEEDS = st.integers(0, 10_000)


def strokes(rng, count, rows=24):
    """Minimum-jerk strokes from rest to rest, one after another, between random places."""
    places = rng.uniform(-1, 1, count + 1)
    shares = minimum_jerk(np.linspace(0, 1, rows))
    return np.concatenate([a + (b - a) * shares for a, b in pairwise(places)])


def recorded(*episodes, channels=None, units=None):
    """Make a recording of arrays [T, D] at 20 Hz."""
    arrays = [np.asarray(e, float) for e in episodes]
    names = tuple(channels or (f"c{i}" for i in range(arrays[0].shape[1])))
    made = tuple(Episode.whole(str(i), a) for i, a in enumerate(arrays))
    units = tuple(units or [""] * len(names))
    return Recording(Path("arm.csv"), names, units, {}, 20.0, made, names)


def found(recording, **choice):
    return examined(recording, choose(**choice)).findings


def wrapped(angle, turn, low):
    return (np.asarray(angle) - low) % turn + low


TURNS = [(2 * np.pi, "rad"), (360.0, "deg"), (2 * np.pi, ""), (360.0, ""), (4096.0, "")]


@given(SEEDS, st.sampled_from(TURNS))
def test_an_angle_that_wraps_is_told_and_unwrapped(seed, turn_and_unit):
    (turn, unit), rng = turn_and_unit, np.random.default_rng(seed)
    angle = turn * (0.3 * strokes(rng, 3) + rng.uniform(-2, 2))
    bent = wrapped(angle, turn, rng.choice([-turn / 2, 0.0]))
    other = strokes(rng, 3)
    recording = recorded(np.stack([bent, other], 1), units=[unit, "m"])
    leaps = np.flatnonzero(np.abs(np.diff(bent)) > turn / 2)

    told = found(recording)
    mended = examined(recording, choose(unwrap=["c0"]))

    if len(leaps):
        assert [(f.channel, f.row, f.count) for f in told] == [("c0", leaps[0] + 1, len(leaps))]
        assert told[0].remedy == "--unwrap c0"
        assert told[0].size == pytest.approx(abs(bent[leaps[0] + 1] - bent[leaps[0]]))
    else:
        assert not told
    assert not mended.findings
    np.testing.assert_allclose(
        np.diff(mended.episodes[0].values[:, 0]), np.diff(angle), atol=1e-9 * turn
    )


def test_unwrapped_episodes_begin_within_half_a_turn_of_each_other_or_of_the_range_given():
    bent = [wrapped(np.linspace(a, a + 2, 20), 2 * np.pi, -np.pi)[:, None] for a in (3, -3.2, 9.1)]
    recording = recorded(*bent)

    own = examined(recording, choose(unwrap=["c0"]))
    given_range = examined(recording, choose(unwrap=["c0"], ranges={"c0": (-6, 0)}))

    starts = np.array([e.values[0, 0] for e in own.episodes])
    assert np.abs(starts - starts[0]).max() <= np.pi
    beside = np.array([e.values[0, 0] for e in given_range.episodes])
    assert np.abs(beside + 3).max() <= np.pi
    np.testing.assert_allclose(wrapped(beside - starts, 2 * np.pi, -1), 0, atol=1e-9)


def test_what_is_no_angle_is_not_unwrapped():
    with pytest.raises(
        ChannelError, match=r"channel 'c0' is in \[m\], in which there are no turns"
    ):
        found(recorded(np.zeros((9, 1)), units=["m"]), unwrap=["c0"])


def turning(rng, rows=60):
    """Unit quaternions of a smooth rotation."""
    angles = np.stack([strokes(rng, 1, rows) for _ in range(4)], 1) + rng.normal(size=4)
    return angles / np.linalg.norm(angles, axis=1, keepdims=True)


@given(SEEDS)
def test_a_quaternion_that_flips_its_sign_is_told_and_turned_back(seed):
    rng = np.random.default_rng(seed)
    smooth, flips = turning(rng), np.sort(rng.choice(np.arange(1, 60), 3, replace=False))
    signs = np.ones(60)
    for row in flips:
        signs[row:] *= -1
    names = ["x", "qx", "qy", "qz", "qw"]
    table = np.column_stack([strokes(rng, 1, 60) * 3, smooth * signs[:, None]])
    recording = recorded(table, channels=names)

    told = found(recording)
    mended = examined(recording, choose(quaternions=["q*"]))

    assert [(f.channel, f.row, f.count) for f in told] == [("qx, qy, qz, qw", flips[0], 3)]
    assert told[0].remedy == "--quaternion qx qy qz qw"
    assert not mended.findings
    np.testing.assert_array_equal(mended.episodes[0].values[:, 1:], smooth)


def test_quaternions_begin_alike_in_every_episode():
    smooth = turning(np.random.default_rng(0))
    mended = examined(recorded(smooth, -smooth), choose(quaternions=["c*"]))

    np.testing.assert_array_equal(mended.episodes[0].values, mended.episodes[1].values)


def test_a_quaternion_has_four_channels():
    with pytest.raises(ChannelError, match="a quaternion has four channels, --quaternion names 3"):
        found(recorded(np.zeros((9, 3))), quaternions=["*"])


@given(SEEDS, st.integers(1, 3), st.sampled_from([-3.0, 3.0, 327.67, -999.0]))
def test_a_spike_is_told_and_becomes_a_gap(seed, rows, value):
    rng = np.random.default_rng(seed)
    clean = np.stack([strokes(rng, 4), strokes(rng, 4)], 1)
    spiked, row = clean.copy(), int(rng.integers(2, 90))
    spiked[row : row + rows, 1] = value
    recording = recorded(clean, spiked)

    told = found(recording)
    mended = examined(recording, choose(leaps="gap"))

    assert [(f.episode, f.channel, f.row, f.count) for f in told] == [("1", "c1", row, 1)]
    assert f"to {value:.4g}" in told[0].what
    assert told[0].remedy == "--leaps gap"
    assert not mended.findings
    hidden = np.argwhere(~mended.episodes[1].observed)
    np.testing.assert_array_equal(hidden, [[row + i, 1] for i in range(rows)])
    assert mended.episodes[0].observed.all()


@given(SEEDS)
def test_motions_glued_together_are_told_and_cut_apart(seed):
    rng = np.random.default_rng(seed)
    motions = [np.stack([strokes(rng, 1, 20 + i) for _ in range(3)], 1) for i in range(3)]
    # Each begins elsewhere than the one before it ended, by as much as the channels move.
    for before, after in pairwise(motions):
        after += before[-1] - after[0] + rng.choice([-2, 2], 3)
    recording = recorded(np.concatenate(motions))

    told = found(recording)
    mended = examined(recording, choose(leaps="cut"))

    assert [(f.episode, f.row, f.count, f.remedy) for f in told] == [("0", 20, 2, "--leaps cut")]
    assert "channels leap at once" in told[0].what
    assert [e.name for e in mended.episodes] == ["0/1", "0/2", "0/3"]
    for episode, motion in zip(mended.episodes, motions, strict=True):
        np.testing.assert_array_equal(episode.values, motion)


def test_a_leap_is_refused_where_that_is_asked_for():
    table = np.concatenate(
        [strokes(np.random.default_rng(0), 2), strokes(np.random.default_rng(1), 2) + 4]
    )

    with pytest.raises(RecordingError, match=r"arm.csv: episode '0', row 48, channel 'c0': a leap"):
        found(recorded(table[:, None]), leaps="refuse")


def gripper(rng, rows):
    return np.repeat(rng.integers(0, 2, rows // 8 + 1), 8)[:rows].astype(float)


NATURES = {
    "strokes": lambda rng, n: strokes(rng, 3, n // 3 + 1)[:n],
    "quick strokes": lambda rng, n: np.repeat(strokes(rng, 12, 3), 3)[:n],
    "strokes and noise": lambda rng, n: strokes(rng, 3, n // 3 + 1)[:n] + 0.02 * rng.normal(size=n),
    "rests": lambda rng, n: np.pad(strokes(rng, 3, n // 3), 9, mode="edge"),
    "noise": lambda rng, n: rng.normal(size=n),
    "noise around the circle": lambda rng, n: rng.uniform(-180, 180, n),
    "random walk": lambda rng, n: rng.normal(size=n).cumsum(),
    "sine": lambda rng, n: np.sin(np.arange(n) * rng.uniform(0.05, 3.0)),
    "gripper": gripper,
    "noisy gripper": lambda rng, n: gripper(rng, n) + 0.003 * rng.normal(size=n),
    "slow gripper": lambda rng, n: np.convolve(gripper(rng, n), np.ones(3) / 3, "same"),
    "phases": lambda rng, n: np.repeat(rng.integers(0, 6, n // 9 + 1), 9)[:n].astype(float),
    "held commands": lambda rng, n: np.repeat(rng.normal(size=n // 7 + 1), 7)[:n],
    "a servo's answer": lambda rng, n: 1 - 0.45 ** np.arange(n),
    "constant": lambda rng, n: np.full(n, 0.3),
    "whole degrees": lambda rng, n: np.round(90 * strokes(rng, 3, n // 3 + 1)[:n]),
}


@pytest.mark.parametrize("nature", NATURES)
@given(seed=SEEDS, rows=st.integers(30, 90), count=st.integers(1, 5))
def test_nothing_is_told_of_what_is_as_it_should_be(nature, seed, rows, count):
    rng = np.random.default_rng(seed)
    episodes = [NATURES[nature](rng, rows)[:, None] for _ in range(count)]

    assert not found(recorded(*episodes))


def test_a_force_at_every_contact_is_its_nature():
    rng = np.random.default_rng(0)
    contact = np.concatenate([np.zeros(30), 5 * np.exp(-np.arange(30) / 3)])
    force = [(contact + 0.1 * np.abs(rng.normal(size=60)))[:, None] for _ in range(4)]

    assert not found(recorded(*force))


def test_rows_after_a_hole_in_the_times_are_no_leap():
    rows = np.delete(np.arange(200), np.arange(60, 100))
    angle = minimum_jerk(rows / 199)[:, None]
    recording = recorded(angle)
    timed = replace(recording.episodes[0], times=rows / 20.0)

    assert not found(replace(recording, episodes=(timed,)))


def test_what_was_not_observed_is_not_looked_at():
    table = strokes(np.random.default_rng(0), 4)[:, None]
    seen = np.ones(table.shape, bool)
    table[17], seen[17] = 1e300, False
    episode = Episode("0", None, table, seen)

    assert not found(replace(recorded(table), episodes=(episode,)))


def test_any_finding_is_refused_where_that_is_asked_for():
    table = strokes(np.random.default_rng(0), 4)
    table[50] = 40.0

    with pytest.raises(
        RecordingError, match=r"row 50, channel 'c0': a spike .* as --strict asks for"
    ):
        prepare(recorded(table[:, None]), choose(strict=True))
    assert prepare(recorded(table[:, None]), choose()).findings[0].row == 50
    assert not prepare(recorded(table[:, None]), choose(strict=True, leaps="gap")).findings
