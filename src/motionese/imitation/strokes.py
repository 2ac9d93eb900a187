"""Strokes of a hand as the robot sees it: where they go, and when that is where they should go."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

WITHIN = np.pi / 4
"""A direction counts as right up to this far [rad] from a true one."""


def stroke(
    begin: Float[ndarray, "*shape 2"], end: Float[ndarray, "*shape 2"]
) -> Float[ndarray, "*shape 2"]:
    """Return direction [rad] and extent [rad] of the seen hand's way between two bearings.

    Directions are 0 rad to the robot's right, π/2 upwards.

    Args:
        begin: Azimuth (to the robot's left) and elevation [rad], as by `body.bearing`.
        end: The same, where the stroke ends.
    """
    azimuth, elevation = np.moveaxis(end - begin, -1, 0)
    right = -azimuth * np.cos(begin[..., 1])
    return np.stack([np.arctan2(elevation, right), np.hypot(right, elevation)], axis=-1)


def directions(
    seen: Float[ndarray, "T 2"], begins: Sequence[int], rows: int
) -> Float[ndarray, " S"]:
    """Return the direction [rad] of every stroke of a motion.

    Args:
        seen: Bearings of the hand [rad], of as many rows as the motion has or more.
        begins: The rows at which its strokes begin.
        rows: How many rows the motion has.
    """
    return stroke(seen[list(begins)], seen[[*begins[1:], rows - 1]])[:, 0]


def near(one: float, other: float) -> bool:
    """Whether directions [rad] are within 45° of each other; one that is NaN is near to none."""
    return bool(np.abs(np.angle(np.exp(1j * (one - other)))) <= WITHIN)
