"""Unit quaternions among channels: q and −q are one rotation, and files change between them."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import ChannelError
from motionese.recordings.choice import Choice, matching
from motionese.recordings.recording import LARGEST, Episode, Recording
from motionese.recordings.series import with_columns

UNIT_NORM = 0.02
"""How far the squared norm of a unit quaternion may be from 1."""
FEW = 50
"""Rows of an episode that show whether a channel may be one of a quaternion's."""
TURNED = -0.5
"""The product of a row's quaternion and the one before, from which on its sign was changed."""


def groups(episodes: Sequence[Episode]) -> list[list[int]]:
    """Return the columns of every four neighbouring channels that are unit quaternions."""
    if not any(len(e.values) for e in episodes) or episodes[0].values.shape[1] < 4:
        return []
    # Most columns are none of a quaternion's, which a few rows show.
    if (_off_unity(episodes, FEW) > UNIT_NORM).all():
        return []
    off = _off_unity(episodes, None)
    found: list[list[int]] = []
    # The nearest to unity first: a neighbour may look like one of the four.
    for first in np.argsort(off, kind="stable"):
        four = [int(first) + i for i in range(4)]
        if off[first] <= UNIT_NORM and not any(set(four) & set(other) for other in found):
            found.append(four)
    return sorted(found)


def _off_unity(episodes: Sequence[Episode], rows: int | None) -> Float[ndarray, " _"]:
    """Return how far the norm of every four neighbours is from 1 at most, in the first rows."""
    off = np.full(episodes[0].values.shape[1] - 3, -np.inf)
    for episode in episodes:
        values = episode.values[:rows]
        known = episode.observed[:rows] & (np.abs(values) <= LARGEST)
        squared = np.square(np.where(known, values, 0.0))
        for first in range(len(off)):
            whole = known[:, first : first + 4].all(axis=1)
            sums = squared[:, first : first + 4].sum(axis=1)
            off[first] = max(off[first], np.abs(sums[whole] - 1).max(initial=-np.inf))
    return np.where(np.isinf(off), np.inf, off)


def signs(episode: Episode, columns: Sequence[int]) -> Float[ndarray, " T"]:
    """Return the sign, 1 or −1, with which every row's quaternion goes on from the one before."""
    quaternions = episode.values[:, columns]
    known = np.flatnonzero(episode.known[:, columns].all(axis=1))
    turned = np.sum(quaternions[known[1:]] * quaternions[known[:-1]], axis=1) < 0
    result = np.ones(len(quaternions))
    result[known[1:]] = np.where(turned, -1.0, 1.0)
    return np.cumprod(result)


def changes(episode: Episode, columns: Sequence[int]) -> list[int]:
    """Return the rows at which a quaternion changes its sign though it hardly rotates."""
    quaternions = np.where(episode.known, episode.values, np.nan)[:, columns]
    products = np.sum(quaternions[1:] * quaternions[:-1], axis=1)
    return [int(row) for row in np.flatnonzero(products < TURNED) + 1]


def turned_back(recording: Recording, columns: Sequence[Sequence[int]]) -> Recording:
    """Return a recording in which the signs of these quaternions agree from row to row.

    Every episode begins with the sign that is nearer to where the first one begins.
    """
    changed: dict[int, list[ndarray]] = {}
    for four in columns:
        each = [signs(e, four)[:, None] * e.values[:, four] for e in recording.episodes]
        starts = [part[:1] for part in each]
        first = next((start for start in starts if start.size), None)
        each = [
            -part if first is not None and (start * first).sum() < 0 else part
            for part, start in zip(each, starts, strict=True)
        ]
        changed |= {c: [part[:, i] for part in each] for i, c in enumerate(four)}
    return with_columns(recording, changed)


def chosen_columns(recording: Recording, choice: Choice) -> list[list[int]]:
    """Return the columns of the quaternions that were named, four by four.

    Raises:
        ChannelError: A channel that does not exist, or not four for every quaternion.
    """
    named = matching(recording, choice.quaternions, recording.channels)
    if len(named) % 4:
        raise ChannelError(
            f"{recording.source}: a quaternion has four channels, "
            f"--quaternion names {len(named)}: {', '.join(named)}"
        )
    columns = sorted(recording.channels.index(name) for name in named)
    return [columns[i : i + 4] for i in range(0, len(columns), 4)]
