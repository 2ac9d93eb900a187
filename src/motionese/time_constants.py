"""How time constants change when a motion is to last longer or shorter. Needs NumPy only.

Equation (1) is Euler's step of τ du/dt = −u + W x + b. Multiplying every τ by a number makes the
same motion last that many times as long, but for the error of the step.
"""

import math

import numpy as np
from numpy import ndarray

from motionese.errors import SettingError

SHORTEST, LONGEST = 0.5, 2.0
"""Allowed scales of a duration; beyond them the step's error shows."""


def scaled_tau(tau: ndarray, scale: float) -> ndarray:
    """Return the time constants [steps] with which motions last `scale` times as long.

    Raises:
        SettingError: A scale outside 0.5 to 2, or one that makes a time constant shorter than the
            step itself.
    """
    if not SHORTEST <= scale <= LONGEST:
        raise SettingError(
            f"the duration scale must lie between {SHORTEST:g} and {LONGEST:g}, got {scale:g}"
        )
    scaled = np.asarray(tau * np.asarray(scale, tau.dtype))
    if scaled.min() < 1:
        raise SettingError(
            f"a duration scale of {scale:g} makes a time constant of {tau.min():g} steps shorter "
            f"than a step; the least this network allows is {math.ceil(1000 / tau.min()) / 1000:g}"
        )
    return scaled
