"""Steps that no arm makes: sudden leaps, and spikes of a few rows.

All is judged against how the channel moves otherwise, over all episodes. A step is a leap where it
crosses `WIDE` of the range, is `FASTER_AROUND` times as fast as every step within `AROUND` rows of
it in the same direction, and `FASTER_ALL` times as fast as every other step that is no leap. A
channel that is still between its leaps, or else moves mostly by sudden steps (a gripper, a phase, a
command that is held), leaps by nature, and is left alone.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float, Int
from numpy import ndarray

from motionese.recordings.series import Series

AROUND = 4
"""Steps on either side with which a step is compared."""
FASTER_AROUND, FASTER_ALL = 8.0, 4.5
"""How many times as fast a leap is at least as the steps around it, and as all others."""
USUAL_LOW, USUAL_HIGH = 0.05, 0.95
"""Between these quantiles of its values lies a channel's usual range."""
LOST_ROWS = 40.0
"""How many rows may have been lost within one step of an arm that moves on."""
WIDE = 0.2
"""Share of its usual range that a leap crosses at least."""
STILL = 0.1
"""Share of its usual range within which a channel stays between leaps that are its nature."""
MOVED = 0.05
"""Share of its usual range from which on a step counts when its nature is judged."""
LONGEST_SPIKE = 3
"""Rows of the longest excursion that counts as a spike, there and back by a leap."""
ENOUGH = 10_000
"""Values of a channel that tell its usual range."""
FEWEST = 8
"""Rows of the shortest series that is judged."""


class Leap(NamedTuple):
    """A leap of one channel: the series it is in, the step after which it is there, its size."""

    series: int
    step: int
    size: float


def leaps(series: Sequence[Series]) -> list[Leap]:
    """Return the leaps of a channel, in the order of its series."""
    width = usual_width(series)
    velocities = [_velocities(s) for s in series]
    calm = [_calm(v) if len(v) >= FEWEST else np.ones(len(v), dtype=bool) for v in velocities]
    sizes = [np.abs(np.diff(s.values)) for s in series]
    wide = [~c & (size >= WIDE * width) for c, size in zip(calm, sizes, strict=True)]
    found = [Leap(i, k, float(sizes[i][k])) for i, k in _fastest(velocities, wide)]
    parts = [np.split(s.values, _steps_in(found, i) + 1) for i, s in enumerate(series)]
    inside = max((float(np.ptp(part)) for each in parts for part in each if len(part)), default=0)
    if inside <= STILL * width:
        return []
    others = [np.delete(size, _steps_in(found, i)) for i, size in enumerate(sizes)]
    kept = [np.delete(c, _steps_in(found, i)) for i, c in enumerate(calm)]
    moved = np.concatenate([np.where(size > MOVED * width, size, 0) for size in others])
    return [] if moved[~np.concatenate(kept)].sum() > 0.5 * moved.sum() else found


def _fastest(
    velocities: Sequence[Float[ndarray, " _"]], wide: Sequence[Bool[ndarray, " _"]]
) -> list[tuple[int, int]]:
    """Return the series and steps of those wide steps that are much faster than all others."""
    fastest = max(
        (float(np.abs(v[~w]).max(initial=0)) for v, w in zip(velocities, wide, strict=True)),
        default=0.0,
    )
    candidates = [
        (float(abs(velocities[i][k])), i, int(k))
        for i, w in enumerate(wide)
        for k in np.flatnonzero(w)
    ]
    found: list[tuple[int, int]] = []
    for speed, i, k in sorted(candidates):
        if found or speed >= FASTER_ALL * fastest:
            found.append((i, k))
        else:
            fastest = max(fastest, speed)
    return sorted(found)


def _steps_in(found: Sequence[Leap], series: int) -> Int[ndarray, " L"]:
    return np.array([leap.step for leap in found if leap.series == series], dtype=np.int64)


def spikes(found: Sequence[Leap], series: Sequence[Series]) -> list[tuple[Leap, Leap]]:
    """Return the pairs of leaps there and back, within `LONGEST_SPIKE` rows, of a channel."""
    pairs: list[tuple[Leap, Leap]] = []
    for out, back in pairwise(found):
        if out.series != back.series or not 0 < back.step - out.step <= LONGEST_SPIKE:
            continue
        values = series[out.series].values
        away = values[out.step + 1] - values[out.step], values[back.step + 1] - values[back.step]
        returns = abs(values[back.step + 1] - values[out.step]) <= 0.5 * min(map(abs, away))
        if away[0] * away[1] < 0 and returns and not (pairs and pairs[-1][1] == out):
            pairs.append((out, back))
    return pairs


def _velocities(series: Series) -> Float[ndarray, " _"]:
    """Return how fast every step goes, and in which direction [unit a row, or a second]."""
    passed = np.diff(series.times)
    # Stamps that come in bunches say nothing of the speed; those after a hole do.
    usual = float(np.median(passed)) if len(passed) else 1.0
    return np.asarray(np.diff(series.values) / np.maximum(passed, usual if usual > 0 else 1.0))


def _calm(velocities: Float[ndarray, " N"]) -> Bool[ndarray, " N"]:
    """Return which steps are not much faster than those around them in the same direction.

    The way back of a spike goes in the other one. A step between two that go on in its direction
    is one in which rows were lost: the arm was on its way.
    """
    windows = np.lib.stride_tricks.sliding_window_view(np.pad(velocities, AROUND), 2 * AROUND + 1)
    neighbours = np.delete(windows, AROUND, axis=1) * np.sign(velocities)[:, None]
    slowest = neighbours[:, AROUND - 1 : AROUND + 1].min(axis=1)
    speeds = np.abs(velocities)
    calm = speeds <= FASTER_AROUND * neighbours.max(axis=1).clip(min=0)
    return np.asarray(calm | (speeds <= LOST_ROWS * slowest))


def usual_width(series: Sequence[Series]) -> float:
    """Return the range of nearly all values [their unit], whatever a few of them are."""
    known = np.concatenate([s.values for s in series])
    known = known[:: max(len(known) // ENOUGH, 1)]
    low, high = np.quantile(known, (USUAL_LOW, USUAL_HIGH)) if len(known) else (0.0, 0.0)
    return float(high - low)
