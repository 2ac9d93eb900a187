"""Segmentation of a hand's path: which sequence of a task it is, and where its primitives begin."""

from functools import lru_cache

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver.demonstration import Demonstration
from motionese.task import PrimitiveSequence, Task

LONGEST = 6
"""Sequences of at most so many primitives are looked for in a path."""
NEAR = 0.2
"""A path is a sequence of the task if its mean distance from the sequence's way is below this share
of the length of a stroke."""
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


def stroke_length(task: Task) -> float:
    """Return how long a stroke is [m]: the mean over the task's primitives."""
    ways = [intended_way(sequence, task) for sequence in task.sequences(1)]
    return float(np.mean([np.linalg.norm(np.diff(way, axis=0), axis=1).sum() for way in ways]))


def sequence_in(path: Float[ndarray, "T 3"], task: Task) -> PrimitiveSequence | None:
    """Return the sequence of the task that a hand's path [m, world] is, or None.

    It is the one whose way is nearest; times do not matter.
    """
    candidates, ways = _candidates(task)
    apart = np.linalg.norm(ways - evenly_along(path), axis=-1).mean(-1)
    nearest = int(apart.argmin())
    return candidates[nearest] if apart[nearest] < NEAR * stroke_length(task) else None


@lru_cache(maxsize=4)
def _candidates(task: Task) -> tuple[list[PrimitiveSequence], Float[ndarray, "S P 3"]]:
    candidates = [s for length in range(1, LONGEST + 1) for s in task.sequences(length)]
    return candidates, np.array([intended_way(sequence, task) for sequence in candidates])


def segmented(
    path: Float[ndarray, "T 3"], sequence: PrimitiveSequence | None, task: Task
) -> Demonstration:
    """Return a path as a demonstration of a sequence of the task, or of nothing that it knows."""
    if sequence is None:
        return Demonstration(path, (0,))
    places = np.array([task.position(name) for name in sequence.places])
    return Demonstration(path, rows_of_places(path, places)[:-1])


def rows_of_places(path: Float[ndarray, "T 3"], places: Float[ndarray, "K 3"]) -> tuple[int, ...]:
    """Return the rows at which a path comes by places in turn, the first of them at row 0.

    The rows rise, and the sum of the distances [m] there is the least possible (by dynamic
    programming): every place is passed where the path is nearest to it, in the order given.
    """
    apart = np.linalg.norm(path[None] - places[:, None], axis=-1)
    rows, count = len(path), len(places)
    cost = np.full((count, rows), np.inf)
    origin = np.zeros((count, rows), dtype=np.int64)
    cost[0, 0] = apart[0, 0]
    for place in range(1, count):
        best, at = np.inf, 0
        for row in range(1, rows):
            if cost[place - 1, row - 1] < best:
                best, at = cost[place - 1, row - 1], row - 1
            cost[place, row], origin[place, row] = best + apart[place, row], at
    passed = [int(cost[-1].argmin())]
    for place in range(count - 1, 0, -1):
        passed.append(int(origin[place, passed[-1]]))
    return tuple(reversed(passed))
