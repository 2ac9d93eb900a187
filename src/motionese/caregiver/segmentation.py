"""Segmentation of a hand's path: where the primitives of what it shows begin."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver.demonstration import Demonstration
from motionese.task import PrimitiveSequence, Task


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
