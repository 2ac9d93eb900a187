"""What is measured of an imitation: errors in centimetres, and whether the buttons were pressed."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import EYE_POSITION, PRESSED_MM, bearing
from motionese.caregiver import BUTTONS, Demonstrating, Motion


def path_error_cm(performed: Float[ndarray, "T 3"], shown: Float[ndarray, "T 3"]) -> float:
    """Return the mean distance [cm] of two hands' paths [m], step by step, in space."""
    return float(100 * np.linalg.norm(performed - shown, axis=1).mean())


def seen_error_cm(
    one: Float[ndarray, "T 6"], other: Float[ndarray, "T 6"], hand: Float[ndarray, "T 3"]
) -> float:
    """Return the mean distance [cm] of two seen hands, across the line of sight.

    Args:
        one: The channels' values; neck and hand coordinates count.
        other: The same of the other hand.
        hand: True positions [m] of one of them, for its distance from the eye.
    """
    angles = _angle_between(bearing(one), bearing(other))
    return float(100 * (angles * np.linalg.norm(hand - EYE_POSITION, axis=1)).mean())


def _angle_between(
    one: Float[ndarray, "T 2"], other: Float[ndarray, "T 2"]
) -> Float[ndarray, " T"]:
    """Return the angle [rad] between directions (azimuth, elevation), by the haversine."""
    half = np.sin((one - other) / 2) ** 2
    return np.asarray(
        2 * np.arcsin(np.sqrt(half[:, 1] + np.cos(one[:, 1]) * np.cos(other[:, 1]) * half[:, 0]))
    )


def press_depths_mm(
    motion: Motion, depths: Float[ndarray, "T 2"], manner: Demonstrating
) -> list[float]:
    """Return how deep [mm] each stroke that should press a button pressed it, in order.

    A stroke's own rows count, and the beginning of the following stroke, since the arm lags behind
    what it is commanded; not the rows before, where an earlier press may not yet be over.
    """
    rows = manner.stroke_steps + manner.rest_steps
    reached = []
    for place, primitive in enumerate(motion.primitives):
        if primitive.presses is not None:
            window = slice(place * rows + rows // 2, (place + 1) * rows + rows // 3)
            reached.append(float(depths[window, BUTTONS.index(primitive.presses)].max()))
    return reached


def pressed(depths_mm: list[float]) -> int:
    """Return how many presses went deep enough."""
    return sum(depth > PRESSED_MM for depth in depths_mm)
