"""What is measured of an imitation: distances of hands, in space and as they are seen [cm]."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import SimulatedRobot


def path_error_cm(performed: Float[ndarray, "T 3"], shown: Float[ndarray, "T 3"]) -> float:
    """Return the mean distance [cm] of two hands' paths [m], step by step, in space."""
    return float(100 * np.linalg.norm(performed - shown, axis=1).mean())


def seen_error_cm(
    body: SimulatedRobot,
    one: Float[ndarray, "T D"],
    other: Float[ndarray, "T D"],
    hand: Float[ndarray, "T 3"],
) -> float:
    """Return the mean distance [cm] of two seen hands, across the line of sight.

    Rows in which one of them was out of view (NaN) do not count; NaN if these are all.

    Args:
        body: Whose eye sees them.
        one: The channels' values; those that tell where the hand is seen count.
        other: The same of the other hand.
        hand: True positions [m] of one of them, for its distance from the eye.
    """
    angles = _angle_between(body.bearing(one), body.bearing(other))
    apart = angles * np.linalg.norm(hand - body.eye_position, axis=1)
    apart = apart[np.isfinite(apart)]
    return float(100 * apart.mean()) if len(apart) else np.nan


def _angle_between(
    one: Float[ndarray, "T 2"], other: Float[ndarray, "T 2"]
) -> Float[ndarray, " T"]:
    """Return the angle [rad] between directions (azimuth, elevation), by the haversine."""
    half = np.sin((one - other) / 2) ** 2
    return np.asarray(
        2 * np.arcsin(np.sqrt(half[:, 1] + np.cos(one[:, 1]) * np.cos(other[:, 1]) * half[:, 0]))
    )
