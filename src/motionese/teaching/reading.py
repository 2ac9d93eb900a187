"""What a path says: which corners it passes, and the motion of the task that this is."""

from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import EYE_POSITION, bearing, on_reach
from motionese.caregiver import PUSHING_BUTTONS, Demonstrating, Motion

ARRIVED_M = 0.09
"""A hand this near to a corner has come there; strokes are 23 cm long."""
WORDS = {"↓": "down", "↑": "up", "←": "to the left"}
PLACES = {
    "UR": "the upper right",
    "UL": "the upper left",
    "LR": "the right button",
    "LL": "the left button",
}

Corners = Mapping[str, Float[ndarray, "3"]]


def corners_of(manner: Demonstrating) -> dict[str, Float[ndarray, "3"]]:
    """Return where the corners are [m, world]."""
    return {name: manner.corner(name) for name in ("UR", "UL", "LR", "LL")}


def hand_seen(values: Float[ndarray, "*shape 6"]) -> Float[ndarray, "*shape 3"]:
    """Return where the hand is [m, world] that was seen with these channels' values."""
    azimuth, elevation = np.moveaxis(bearing(values), -1, 0)
    level = np.cos(elevation)
    rays = [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)]
    return on_reach(EYE_POSITION, np.stack(rays, axis=-1))


def nearest_corner(position: Float[ndarray, "3"], corners: Corners) -> str:
    """Return the corner nearest to a position [m, world]."""
    return min(corners, key=lambda name: float(np.linalg.norm(corners[name] - position)))


def corners_passed(path: Float[ndarray, "T 3"], corners: Corners) -> tuple[str, ...]:
    """Return the corners that a hand's path [m, world] passes, where it begins first."""
    passed = [nearest_corner(path[0], corners)]
    for position in path:
        near = nearest_corner(position, corners)
        arrived = float(np.linalg.norm(corners[near] - position)) < ARRIVED_M
        if arrived and near != passed[-1]:
            passed.append(near)
    return tuple(passed)


def motion_through(corners: Sequence[str]) -> Motion | None:
    """Return the motion of the task through these corners, or None where there is none."""
    strokes = {(p.start, p.end): p for p in PUSHING_BUTTONS.primitives}
    passed = [strokes.get(pair) for pair in pairwise(corners)]
    whole = [primitive for primitive in passed if primitive is not None]
    return Motion(tuple(whole)) if whole and len(whole) == len(passed) else None


def motion_read(path: Float[ndarray, "T 3"], corners: Corners) -> Motion | None:
    """Return the motion of the task that a hand's path [m, world] is, or None."""
    return motion_through(corners_passed(path, corners))


def in_words(motion: Motion) -> str:
    """Return a motion in words, such as 'from the upper right down, then to the left'."""
    return f"from {PLACES[motion.start]} " + ", then ".join(
        WORDS[primitive.arrow] for primitive in motion.primitives
    )


def arrows_passed(path: Float[ndarray, "T 3"], corners: Corners) -> str:
    """Return the start corner, and arrows of what a path has completed of a motion of the task."""
    passed = corners_passed(path, corners)
    for count in range(len(passed), 1, -1):
        motion = motion_through(passed[:count])
        if motion is not None:
            return motion.name
    return passed[0]
