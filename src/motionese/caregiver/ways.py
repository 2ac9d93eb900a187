"""Ways of a hand through space, whatever their timing."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.task import PrimitiveSequence, Task

POINTS = 64
"""Ways are compared at so many points."""


def intended_way(
    sequence: PrimitiveSequence, task: Task, points: int = POINTS
) -> Float[ndarray, "P 3"]:
    """Return points [m, world], evenly along a sequence's way."""
    share = np.linspace(0.0, 1.0, points)
    strokes = [
        p.way(share, task.position(p.start), task.position(p.end)) for p in sequence.primitives
    ]
    return evenly_along(np.concatenate(strokes), points)


def evenly_along(path: Float[ndarray, "R 3"], points: int = POINTS) -> Float[ndarray, "P 3"]:
    """Return points at even distances along a path: its way, whatever its timing."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    done = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, done[-1], points)
    return np.stack([np.interp(at, done, column) for column in path.T], axis=-1)


def way_length(path: Float[ndarray, "*shape R 3"]) -> Float[ndarray, "*shape"]:
    """Return how long paths are [m]."""
    return np.asarray(np.linalg.norm(np.diff(path, axis=-2), axis=-1).sum(-1))


def stroke_length(task: Task) -> float:
    """Return how long a stroke is [m]: the mean over the task's primitives."""
    ways = [intended_way(sequence, task) for sequence in task.sequences(1)]
    return float(np.mean([way_length(way) for way in ways]))
