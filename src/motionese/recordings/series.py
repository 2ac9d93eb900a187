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


def series_of(recording: Recording, column: int) -> list[Series]:
    """Return a channel's series in every episode."""
    series = []
    for episode in recording.episodes:
        values = episode.values[:, column]
        rows = np.flatnonzero(episode.observed[:, column] & (np.abs(values) <= LARGEST))
        times = rows.astype(np.float64) if episode.times is None else episode.times[rows]
        series.append(Series(rows, values[rows], times))
    return series


def largest_steps(recording: Recording) -> Float[ndarray, " D"]:
    """Return every channel's largest step between values that follow each other [its unit]."""
    result = np.zeros(len(recording.channels))
    for episode in recording.episodes:
        known = episode.known
        if known.all():
            steps = np.abs(np.diff(episode.values, axis=0)).max(axis=0, initial=0)
        else:
            columns = zip(episode.values.T, known.T, strict=True)
            steps = np.array([np.abs(np.diff(v[k])).max(initial=0) for v, k in columns])
        result = np.maximum(result, steps)
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
