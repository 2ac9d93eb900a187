"""One channel of a recording as series, one an episode, of what was observed of it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.recordings.recording import LARGEST, Recording


class Series(NamedTuple):
    """One channel in one episode, where it was observed and is finite.

    Attributes:
        rows: The rows of the episode.
        values: In the channel's unit.
        times: Of the rows [s], or the rows themselves.
    """

    rows: Int[ndarray, " K"]
    values: Float[ndarray, " K"]
    times: Float[ndarray, " K"]


def series_of(recording: Recording, column: int, every: int = 1) -> list[Series]:
    """Return a channel's series in every episode, of all rows or of one in `every`."""
    series = []
    for episode in recording.episodes:
        # A column that lies together is gone through several times as fast.
        values = np.ascontiguousarray(episode.values[::every, column])
        known = episode.observed[::every, column] & (np.abs(values) <= LARGEST)
        rows = np.flatnonzero(known)
        values, rows = values if len(rows) == len(values) else values[rows], rows * every
        times = rows.astype(np.float64) if episode.times is None else episode.times[rows]
        series.append(Series(rows, values, times))
    return series


def largest_steps(recording: Recording) -> Float[ndarray, " D"]:
    """Return every channel's largest step between values that follow each other [its unit]."""
    result = np.zeros(len(recording.channels))
    for episode in recording.episodes:
        for values, observed in episode.blocks(overlap=1):
            if not (observed.all() and np.abs(values).max() <= LARGEST):
                columns = zip(episode.values.T, episode.known.T, strict=True)
                steps = np.array([np.abs(np.diff(v[k])).max(initial=0) for v, k in columns])
                result = np.maximum(result, steps)
                break
            result = np.maximum(result, np.abs(np.diff(values, axis=0)).max(axis=0))
    return result


def with_columns(
    recording: Recording, columns: Mapping[int, Sequence[Float[ndarray, " _"]]]
) -> Recording:
    """Return a recording with other values in some columns: one array [T] for every episode."""
    if not columns:
        return recording
    episodes = []
    for i, episode in enumerate(recording.episodes):
        values = episode.values.copy()
        for column, each in columns.items():
            values[:, column] = each[i]
        episodes.append(replace(episode, values=values))
    return replace(recording, episodes=tuple(episodes))
