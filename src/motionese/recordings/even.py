"""Putting rows that were recorded at uneven times on an even grid, hole by hole."""

from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.recording import Episode, Recording

JITTER = 0.1
"""Share of an interval by which a row may be off the grid and still count as on it."""
HOLE = 2.5
"""Usual intervals of a channel from which on nothing is filled in between two samples."""
LONGEST = 1000
"""Grid rows for every recorded row beyond which the times cannot be meant."""


def even(recording: Recording, rate_hz: float) -> Recording:
    """Return the recording at evenly spaced rows, without times.

    Rows that are on the grid already are kept bit for bit. Otherwise every channel is
    interpolated linearly between its own observed samples; within a hole nothing is observed.

    Raises:
        RecordingError: The times of an episode span far more rows than it has.
    """
    episodes = []
    for episode in recording.episodes:
        placed = episode
        if episode.times is not None and len(episode.times) > 1:
            placed = _on_grid(recording, episode, (episode.times - episode.times[0]) * rate_hz)
        episodes.append(replace(placed, times=None))
    return replace(recording, rate_hz=rate_hz, episodes=tuple(episodes))


def _on_grid(recording: Recording, episode: Episode, at: Float[ndarray, " T"]) -> Episode:
    """Return an episode whose rows were recorded `at` these positions, in rows of the grid."""
    if np.abs(at - np.arange(len(at))).max() <= JITTER:
        return episode
    if at[-1] > LONGEST * len(at):
        raise RecordingError(
            f"{recording.source}: episode '{episode.name}' has {len(at)} rows, "
            f"but its times span {at[-1]:.3g}; check its times"
        )
    grid = np.arange(int(at[-1] + JITTER) + 1, dtype=np.float64)
    values = np.zeros((len(grid), len(recording.channels)))
    observed = np.zeros(values.shape, dtype=bool)
    for column, seen in enumerate(episode.observed.T):
        if seen.any():
            samples = episode.values[seen, column]
            values[:, column] = np.interp(grid, at[seen], samples)
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
