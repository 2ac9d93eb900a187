"""Movements and the pauses between them, in a smoothed track.

A hand is still where its speed is below a threshold. The threshold is `STILL` of the motion's
robust peak speed (a common rule for the onset of reaching, 5 % of peak velocity), and never below
what noise alone would exceed. Speed rises slowly, so the time below the threshold is longer than
the rest: where a movement begins and ends is therefore followed back along the rise of a movement
of minimum jerk (T. Flash and N. Hogan, Journal of Neuroscience 5, 1985), of which the threshold is
but a sign (L. Botzer and A. Karniel, Frontiers in Neuroscience 3, 2009, do it with a cubic).
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray
from numpy.lib.stride_tricks import sliding_window_view

from motionese.kinematics.tracks import Track

STILL = 0.05
"""Share of the robust peak speed below which a hand is still."""
SHARE_OF_WAY = 0.9
"""The robust peak speed is the one below which this share of the way is covered. A share of the
way and not of the time: however long a hand rests, it is the same."""
ABOVE_NOISE = 3.0
"""The threshold is at least so many times the speed that noise makes of a hand at rest."""
SMALLEST = 0.02
"""What leads less far than this share of the range is no movement, but stillness."""
RISE_LOW, RISE_HIGH = 0.1, 0.7
"""Between these shares of its first peak a rise of speed tells when the movement began."""
PEAK_S = 0.1
"""A peak of speed is the highest within so many seconds on either side."""


class Movement(NamedTuple):
    """A movement between two moments of stillness, or the ends of what was recorded.

    Attributes:
        start_s, end_s: From the motion's first row [s].
        length: Of its way [unit].
        distance: Between its ends [unit].
        peak_speed: The largest [unit/s].
        peak_acceleration: The largest [unit/s²].
        velocity_change: Integral of the norm of its acceleration over time [unit/s].
        from_rest, to_rest: Whether it was seen to begin and to end at rest.
    """

    start_s: float
    end_s: float
    length: float
    distance: float
    peak_speed: float
    peak_acceleration: float
    velocity_change: float
    from_rest: bool
    to_rest: bool

    @property
    def seconds(self) -> float:
        """How long it lasts [s]."""
        return self.end_s - self.start_s


class Pause(NamedTuple):
    """Stillness between two movements.

    Attributes:
        start_s, end_s: From the motion's first row [s].
        position: Where the hand is meanwhile, on average [unit]. [D]
    """

    start_s: float
    end_s: float
    position: Float[ndarray, " D"]

    @property
    def seconds(self) -> float:
        """How long it lasts [s]."""
        return self.end_s - self.start_s


def still_speed(tracks: Sequence[Track]) -> tuple[float, bool]:
    """Return the speed [unit/s] below which a hand counts as still, and whether noise sets it."""
    speeds = np.concatenate([track.speeds for track in tracks])
    weights = np.concatenate([track.speeds * track.step_s for track in tracks])
    order = np.argsort(speeds)
    covered = np.cumsum(weights[order])
    peak = float(speeds[order][np.searchsorted(covered, SHARE_OF_WAY * covered[-1])])
    noise = ABOVE_NOISE * max(track.noise_speed for track in tracks)
    return max(STILL * peak, noise), noise > STILL * peak


def movements_of(track: Track, still: float, pause_s: float, smallest: float) -> list[Movement]:
    """Return the movements of a track, in order.

    Args:
        track: The smoothed motion.
        still: The speed below which it is still [unit/s].
        pause_s: Stillness that is shorter does not part two movements [s].
        smallest: How far a movement leads at least [unit].
    """
    moving = np.concatenate([[False], track.speeds >= still, [False]])
    spans: list[tuple[float, float]] = []
    for start, stop in np.flatnonzero(np.diff(moving.astype(np.int8))).reshape(-1, 2):
        part = track.positions[start:stop]
        if np.linalg.norm(part - part[0], axis=1).max() <= smallest:
            continue
        rows = np.arange(start, stop)
        begin, end = _edge(track, rows, still), _edge(track, rows[::-1], still)
        if spans and begin - spans[-1][1] < pause_s:
            spans[-1] = spans[-1][0], end
        else:
            spans.append((begin, end))
    return [_movement(track, still, *span) for span in spans]


def pauses_of(track: Track, movements: Sequence[Movement]) -> list[Pause]:
    """Return the pauses between the movements of a track."""
    pauses = []
    for before, after in pairwise(movements):
        rows = slice(*np.searchsorted(track.times, [before.end_s, after.start_s]))
        position = track.positions[rows].mean(axis=0)
        pauses.append(Pause(before.end_s, after.start_s, position))
    return pauses


def _edge(track: Track, rows: Int[ndarray, " _"], still: float) -> float:
    """Return when [s] the speed that crosses the threshold at `rows[0]` left zero.

    `rows` lead into the movement: forwards from its beginning, or backwards from its end. A
    movement of minimum jerk has the share q = 16 p² (1 − p)² of its peak speed at the phase
    p(q) = (1 − √(1 − √q)) / 2, so that t = edge + duration · p(q) is a line through its rise,
    whose intercept is sought. It lies within the stillness, no further from the threshold than
    the peak is.
    """
    times, speeds = track.times[rows], track.speeds[rows]
    if rows[0] in (0, len(track.times) - 1):
        return float(times[0])
    first_peak = _first_peak(speeds, max(round(PEAK_S / track.step_s), 1))
    share = np.minimum(speeds[: first_peak + 1] / speeds[first_peak], 1.0)
    rise = np.flatnonzero(share >= RISE_LOW)
    rise = rise[: np.argmax(share[rise] >= RISE_HIGH)]
    phase = (1 - np.sqrt(1 - np.sqrt(share[rise]))) / 2
    if len(rise) < 2 or np.ptp(phase) == 0:
        return float(times[0])
    edge = np.polyfit(phase, times[rise], 1)[1]
    outer = np.clip(2 * times[0] - times[first_peak], track.times[0], track.times[-1])
    return float(np.clip(edge, min(outer, times[0]), max(outer, times[0])))


def _first_peak(speeds: Float[ndarray, " _"], around: int) -> int:
    """Return the first row that is the highest within so many rows on either side."""
    padded = np.pad(speeds, around, constant_values=-1.0)
    highest = sliding_window_view(padded, 2 * around + 1).max(axis=1)
    return int(np.argmax(speeds >= highest))


def _movement(track: Track, still: float, start_s: float, end_s: float) -> Movement:
    first, last = np.searchsorted(track.times, [start_s, end_s])
    rows = slice(first, max(last, first + 1))
    ends = [
        np.array([np.interp(t, track.times, column) for column in track.positions.T])
        for t in (start_s, end_s)
    ]
    distance = float(np.linalg.norm(ends[1] - ends[0]))
    length = float(track.speeds[rows].sum() * track.step_s)
    return Movement(
        start_s,
        end_s,
        max(length, distance),
        distance,
        float(track.speeds[rows].max()),
        float(track.accelerations[rows].max()),
        float(track.accelerations[rows].sum() * track.step_s),
        bool(track.speeds[0] < still or start_s > track.times[0]),
        bool(track.speeds[-1] < still or end_s < track.times[-1]),
    )
