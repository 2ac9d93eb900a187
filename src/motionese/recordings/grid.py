"""Rows on an even grid: recorded at uneven times, filled hole by hole, or at another rate."""

from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError, SettingError
from motionese.recordings.recording import Episode, Recording

JITTER = 0.1
"""Share of an interval by which a row may be off the grid and still count as on it."""
HOLE = 2.5
"""Usual intervals of a channel from which on nothing is filled in between two samples."""
LONGEST = 1000
"""Grid rows for every recorded row beyond which the times cannot be meant."""
FASTER = 100
"""Largest factor by which a rate can be raised."""


def even(recording: Recording, rate_hz: float) -> Recording:
    """Return the recording at evenly spaced rows, without times.

    Rows that are on the grid already are kept bit for bit. Otherwise every channel is
    interpolated linearly between its own observed samples; within a hole nothing is observed.
    So it is, too, where a file tells both a rate and times: rows are there whenever any channel
    was recorded, and a slower one has no gaps but a rate of its own.
    """
    source, is_log = recording.source, recording.rate_hz is not None
    on_grid = recording.map(lambda e: replace(_on_grid(source, e, rate_hz, is_log), times=None))
    return replace(on_grid, rate_hz=rate_hz)


def resampled(recording: Recording, rate_hz: float) -> Recording:
    """Return an evenly spaced recording at another rate [Hz].

    Going down, every channel is averaged first, over a window of one new interval around each
    row, so that nothing faster folds into the new rate and nothing is delayed. A new row is
    observed where both rows around it were.
    """
    assert recording.rate_hz is not None
    step = recording.rate_hz / rate_hz
    if abs(step - 1) < 1e-9:
        return recording
    if step * FASTER < 1:
        raise SettingError(
            f"{recording.source}: recorded at {recording.rate_hz:g} Hz, it cannot be "
            f"resampled to {rate_hz:g} Hz, more than {FASTER} times as much"
        )
    changed = recording.map(lambda e: _resampled(e, step) if len(e.values) else e)
    return replace(changed, rate_hz=rate_hz)


def _on_grid(source: Path, episode: Episode, rate_hz: float, is_log: bool) -> Episode:
    if episode.times is None or len(episode.times) < 2:
        return episode
    at = (episode.times - episode.times[0]) * rate_hz
    if np.abs(at - np.arange(len(at))).max() <= JITTER:
        if not is_log:
            return episode
        at = np.arange(len(at), dtype=np.float64)
    if at[-1] > LONGEST * len(at):
        raise RecordingError(
            f"{source}: episode '{episode.name}' has {len(at)} rows, "
            f"but its times span {at[-1]:.3g}; check its times"
        )
    grid = np.arange(int(at[-1] + JITTER) + 1, dtype=np.float64)
    values = np.zeros((len(grid), episode.values.shape[1]))
    observed = np.zeros(values.shape, dtype=bool)
    for column, seen in enumerate(episode.observed.T):
        if seen.any():
            values[:, column] = np.interp(grid, at[seen], episode.values[seen, column])
            observed[:, column] = _near(grid, at[seen])
    return Episode(episode.name, None, values, observed)


def _near(grid: Float[ndarray, " G"], at: Float[ndarray, " K"]) -> Bool[ndarray, " G"]:
    """Return which rows of the grid lie beside a sample or between two that are no hole apart."""
    after = np.searchsorted(at, grid)
    left, right = at[np.maximum(after - 1, 0)], at[np.minimum(after, len(at) - 1)]
    beside = np.minimum(np.abs(grid - left), np.abs(grid - right)) <= 0.5
    usual = max(float(np.median(np.diff(at))), 1.0) if len(at) > 1 else 1.0
    between = (after > 0) & (after < len(at)) & (right - left <= HOLE * usual)
    return np.asarray(beside | between)


def _resampled(episode: Episode, step: float) -> Episode:
    values = np.where(episode.observed, episode.values, 0.0)
    if step > 1:
        for column, seen in enumerate(episode.observed.T):
            edges = np.flatnonzero(np.diff(np.concatenate([[False], seen, [False]])))
            for start, end in edges.reshape(-1, 2):
                values[start:end, column] = _averaged(values[start:end, column], step)
    # A tiny bit beyond the last row is that row, or rounding would cost it.
    at = np.arange(int((len(values) - 1) / step + 1e-9) + 1) * step
    before = np.minimum((at + 1e-9).astype(int), len(values) - 1)
    share = np.clip(at - before, 0.0, None)[:, None]
    share[share < 1e-9] = 0.0
    after = np.minimum(before + 1, len(values) - 1)
    return replace(
        episode,
        values=(1 - share) * values[before] + share * values[after],
        observed=episode.observed[before] & (episode.observed[after] | (share == 0)),
    )


def _averaged(run: Float[ndarray, " R"], width: float) -> Float[ndarray, " R"]:
    """Return the mean over `width` rows around every row of a run without gaps.

    Beyond its ends the run is turned about its end points, so that a straight line stays one.
    """
    reach = min(int(np.ceil((width - 1) / 2)), len(run) - 1)
    offsets = np.arange(-reach, reach + 1)
    weights = np.clip(width / 2 + 0.5 - np.abs(offsets), 0.0, 1.0)
    padded = np.pad(run, reach, mode="reflect", reflect_type="odd")
    return np.asarray(np.convolve(padded, weights / weights.sum(), mode="valid"))
