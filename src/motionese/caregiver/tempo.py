"""A person's path at the tempo of the scripted caregiver.

A person moves at a tempo of their own, the network knows one: still time is cut as the scripted
caregiver cuts it, and what is left is played evenly slower or faster.
"""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

STILL_M = 0.004
"""A hand that moves less than this from row to row rests."""


def lasting(path: Float[ndarray, "R D"], rows: int) -> Float[ndarray, "T D"]:
    """Return a path played evenly faster or slower, so that it has so many rows."""
    before, now = np.linspace(0, 1, len(path)), np.linspace(0, 1, rows)
    return np.stack([np.interp(now, before, column) for column in path.T], axis=-1)


def moving(path: Float[ndarray, "R 3"], rest_steps: int) -> Float[ndarray, "M 3"]:
    """Cut stillness to one row at both ends, and to the caregiver's rest in between."""
    kept: list[int] = [0]
    still = 0
    for row in range(1, len(path)):
        still = still + 1 if _still(path, kept[-1], row) else 0
        if still <= (rest_steps if len(kept) > 1 else 0):
            kept.append(row)
    while len(kept) > 2 and _still(path, kept[-2], kept[-1]):
        kept.pop()
    return path[kept] if len(kept) > 1 else path[[0, 0]]


def _still(path: Float[ndarray, "R 3"], one: int, other: int) -> bool:
    return float(np.linalg.norm(path[other] - path[one])) < STILL_M
