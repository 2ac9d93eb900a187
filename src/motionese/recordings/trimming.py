"""Cutting the rows at both ends of an episode in which nothing moves yet, or any more."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.recordings.recording import Episode, Recording


def trimmed(
    recording: Recording, share: float, ranges: Mapping[str, tuple[float, float]]
) -> Recording:
    """Return the recording without the still ends of its episodes.

    A row is still while no channel has moved by more than `share` of its range from the first
    row (from the last, at the end). Of either end the last still row is kept. An episode that
    is still throughout has no ends, and is kept whole.
    """
    widths = np.array([ranges[c][1] - ranges[c][0] for c in recording.channels])
    episodes = []
    for episode in recording.episodes:
        start, end = still_ends(episode, share * widths)
        rows = slice(start, len(episode.values) - end)
        if rows.stop - rows.start < 2:
            rows = slice(None)
        episodes.append(
            replace(episode, values=episode.values[rows], observed=episode.observed[rows])
        )
    return replace(recording, episodes=tuple(episodes))


def still_ends(episode: Episode, limits: Float[ndarray, " D"]) -> tuple[int, int]:
    """Return how many rows at the start and at the end can be cut, one still row being kept."""
    return _still_rows(episode.values, episode.observed, limits), _still_rows(
        episode.values[::-1], episode.observed[::-1], limits
    )


def _still_rows(
    values: Float[ndarray, "T D"], observed: Bool[ndarray, "T D"], limits: Float[ndarray, " D"]
) -> int:
    """Return the rows before the last one that is still at its channels' first values."""
    if not len(values):
        return 0
    first = values[np.argmax(observed, axis=0), np.arange(len(limits))]
    # What was not observed may be NaN or infinite.
    with np.errstate(invalid="ignore"):
        moved = ((np.abs(values - first) > limits) & observed).any(axis=1)
    return max(int(np.argmax(moved)) - 1, 0) if moved.any() else len(values) - 1
