"""The shape of a way: how far it extends, and how often it is gone again."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.kinematics.movements import Movement
from motionese.kinematics.tracks import Track

BESIDE = 0.1
"""Share of the range within which a way lies beside another."""
SAME_WAY = np.sqrt(0.5)
"""Cosine of the largest angle [45°] between directions that are the same."""
SPACING = 0.02
"""Share of the range between the points at which a way is looked at."""
MOST = 4000
"""Points of a way at most."""
CHUNK = 512


def extent(points: Float[ndarray, "G D"]) -> float:
    """Return the largest distance between two points."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    away = np.linalg.norm(points - middle, axis=1)
    first = points[away.argmax()]
    longest = float(np.linalg.norm(points - first, axis=1).max())
    # The ends of a longer distance lie further out than this.
    points = points[away >= longest - away.max()]
    for start in range(0, len(points), CHUNK):
        part = points[start : start + CHUNK, None] - points[None, start:]
        longest = max(longest, float(np.sqrt((part**2).sum(axis=-1).max())))
    return longest


def repetitiveness(
    tracks: Sequence[Track], movements: Sequence[Sequence[Movement]], extent: float
) -> float:
    """Return the length of the way over that of its new parts; 1 where nothing is repeated.

    A point of the way is a repetition if the hand was beside it before (within `BESIDE` of the
    range, abreast of it), going the same way (within 45°), and has gone at least twice that far
    since.

    Args:
        tracks: The smoothed motion.
        movements: Those of every track.
        extent: The range [unit].
    """
    length = sum(m.length for each in movements for m in each)
    spacing = max(SPACING * extent, length / MOST)
    parts = [
        _points(track, movement, spacing)
        for track, each in zip(tracks, movements, strict=True)
        for movement in each
    ]
    points, directions = (np.concatenate(each) for each in zip(*parts, strict=True))
    new = 0
    for i, (point, direction) in enumerate(zip(points, directions, strict=True)):
        before = max(i - round(2 * BESIDE * extent / spacing), 0)
        apart = points[:before] - point
        beside = (apart**2).sum(axis=1) <= (BESIDE * extent) ** 2
        abreast = np.abs(apart @ direction) <= 0.51 * spacing
        same = directions[:before] @ direction >= SAME_WAY
        new += not (beside & abreast & same).any()
    return len(points) / new


def _points(
    track: Track, movement: Movement, spacing: float
) -> tuple[Float[ndarray, "P D"], Float[ndarray, "P D"]]:
    """Return points at even distances along a movement's way, and its directions there."""
    rows = slice(*np.searchsorted(track.times, [movement.start_s, movement.end_s]))
    way = track.positions[rows]
    done = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(way, axis=0), axis=1))])
    edges = np.linspace(0.0, done[-1], max(round(done[-1] / spacing), 1) + 1)
    at = np.stack([np.interp(edges, done, column) for column in way.T], axis=-1)
    steps = np.diff(at, axis=0)
    lengths = np.linalg.norm(steps, axis=1, keepdims=True)
    return (at[1:] + at[:-1]) / 2, np.divide(steps, lengths, out=steps, where=lengths > 0)
