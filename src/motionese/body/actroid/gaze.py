"""The eye: where it is, how it follows a hand, and in which direction the hand it sees lies."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.eye import focal_px

EYE_POSITION: Float[ndarray, "3"] = np.array([0.02, 0.0, 1.33])
"""The eye [m, world]; pan and tilt axes meet in it, so that it stays there while the head turns."""
FOCAL_PX = focal_px(50.0)
"""Focal length [px] for the eye's vertical field of view of 50°."""
SERVO_GAIN = 0.5
"""Share of the seen error that one correction of the gaze removes."""


def followed(gaze: Float[ndarray, "2"], seen: Float[ndarray, "2"]) -> Float[ndarray, "2"]:
    """Return the commanded pan and tilt [rad], corrected for a hand seen at (u, v) [px].

    A pan moves the picture by the cosine of the tilt less than a tilt does.
    """
    right, down = np.arctan2(seen, FOCAL_PX)
    return gaze + SERVO_GAIN * np.array([-right / np.cos(gaze[1]), down])


def aimed_at(position: Float[ndarray, "3"]) -> Float[ndarray, "2"]:
    """Return the pan and tilt [rad] that bring a position [m, world] into the view's middle."""
    x, y, z = position - EYE_POSITION
    return np.array([np.arctan2(y, x), -np.arctan2(z, np.hypot(x, y))])


def bearing(values: Float[ndarray, "*shape 6"]) -> Float[ndarray, "*shape 2"]:
    """Return the direction in which the seen hand lies, from the channels' values.

    The ray of pixel (u, v) is turned by tilt, then by pan: both rotations exactly, not their sum.
    """
    _, _, pan, tilt, u, v = np.moveaxis(np.asarray(values, dtype=np.float64), -1, 0)
    left, up = -u / FOCAL_PX, -v / FOCAL_PX
    ahead = np.cos(tilt) + up * np.sin(tilt)
    height = -np.sin(tilt) + up * np.cos(tilt)
    azimuth = pan + np.arctan2(left, ahead)
    return np.stack([azimuth, np.arctan2(height, np.hypot(ahead, left))], axis=-1)
