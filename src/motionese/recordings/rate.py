"""At which rate rows were recorded: as the file says, as its times show, or as the user says."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.recording import Episode, Recording

DIFFERS = 0.02
"""Share by which a rate that the user gives may differ from the file's."""
OTHER_RATE = 0.05
"""Share by which the rates of episodes differ, beyond their uncertainty, where they are others."""
DROPPED = 1.5
"""Usual intervals from which on a row between two others was dropped."""
OFF = 0.05
"""Rows by which the rounding of a rate may at most put off an episode's last row."""
LATEST_S = 1e30
"""A time [s] that is no more than a number."""
SLOWEST_HZ, FASTEST_HZ = 1e-3, 1e6


def of_one_rate(recording: Recording) -> list[tuple[Episode, ...]]:
    """Return the episodes in groups of one rate, as their times show it, in order of appearance.

    Episodes without times belong to the first group.

    Raises:
        RecordingError: Times that are not finite, or do not rise.
    """
    _rising_times(recording)
    groups: list[tuple[float, float, list[Episode]]] = []
    others: list[Episode] = []
    for episode in recording.episodes:
        rate = None if episode.times is None else rate_of_times([episode.times])
        if episode.times is None or rate is None or not 0 < rate < np.inf:
            others.append(episode)
            continue
        off = _uncertainty(np.diff(episode.times) * rate)
        near = (g for r, o, g in groups if abs(r - rate) <= (OTHER_RATE + o + off) * max(r, rate))
        if (group := next(near, None)) is None:
            groups.append((rate, off, [episode]))
        else:
            group.append(episode)
    if not groups:
        return [recording.episodes]
    groups[0][2].extend(others)
    return [tuple(group) for _, _, group in groups]


def _uncertainty(intervals: Float[ndarray, " _"]) -> float:
    """Return three standard errors of the mean of intervals, those with dropped rows aside."""
    near = intervals[intervals < DROPPED]
    return float(3 * near.std() / np.sqrt(len(near))) if len(near) else np.inf


def rate_of(recording: Recording, given_hz: float | None) -> float:
    """Return the rows per second [Hz] of a recording; the user's where the file tells none."""
    shown = rate_of_times(_rising_times(recording))
    told = shown if recording.rate_hz is None else recording.rate_hz
    if told is None:
        if given_hz is None:
            raise RecordingError(
                f"{recording.source}: tells neither times nor a rate; "
                "give the rate [Hz] it was recorded at: --rate (or, of a table, its times: --time)"
            )
        return given_hz
    if not SLOWEST_HZ <= told <= FASTEST_HZ:
        raise RecordingError(
            f"{recording.source}: rows are {1 / told:g} s apart; are its times in seconds? "
            "A column can name its unit, as in 'time [ms]'"
        )
    if given_hz is not None and abs(told - given_hz) > DIFFERS * told:
        raise RecordingError(
            f"{recording.source}: recorded at {told:g} Hz, but its rate is given as "
            f"{given_hz:g} Hz; leave that out, or resample to it: --resample {given_hz:g}"
        )
    return told


@np.errstate(over="ignore", invalid="ignore")
def rate_of_times(times: Sequence[Float[ndarray, " _"]]) -> float | None:
    """Return the rate that rising times show, dropped rows left aside; None without two rows."""
    intervals = np.concatenate([np.empty(0), *(np.diff(t) for t in times)])
    if not len(intervals):
        return None
    near = intervals[intervals < DROPPED * np.median(intervals)]
    rate = 1.0 / float(near.mean())
    # Stamps are rounded: the rate is the shortest number that they cannot tell from their mean.
    off = min(max(float(np.abs(near * rate - 1).max()), 1e-9), OFF)
    longest = max(float(t[-1] - t[0]) for t in times if len(t))
    rounded = (float(f"{rate:.{digits}g}") for digits in range(1, 18))
    return next(r for r in rounded if abs(r - rate) * longest <= off or r == rate)


def _rising_times(recording: Recording) -> list[Float[ndarray, " _"]]:
    named = [(e.name, e.times) for e in recording.episodes if e.times is not None]
    for name, times in named:
        back = np.flatnonzero(~(np.diff(times) > 0))
        if len(back) or not (np.abs(times) < LATEST_S).all():
            row = back[0] + 1 if len(back) else 0
            raise RecordingError(
                f"{recording.source}: episode '{name}', row {row}: time must be finite and rise"
            )
    return [times for _, times in named]
