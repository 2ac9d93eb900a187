"""Movements of minimum jerk (Flash & Hogan 1985), and how long a transition takes. NumPy only."""

import math

import numpy as np
from numpy import ndarray

PEAK = 1.875
"""The largest slope of 10 s³ − 15 s⁴ + 6 s⁵."""
SHORTEST = 10
"""Rows of the shortest transition: a motion that begins elsewhere needs some to find its way."""


def minimum_jerk(phase: ndarray | float) -> ndarray:
    """Return the share of a movement done at a share of its duration, 10 s³ − 15 s⁴ + 6 s⁵."""
    return np.asarray(phase**3 * (10 - 15 * phase + 6 * phase**2))


def transition_rows(apart: ndarray, speed: ndarray, most: int) -> int:
    """Return the rows in which a transition is about as fast as the motions it connects.

    Args:
        apart: How far it leads, in the channels' units. [D]
        speed: The motions' largest change from one row to the next. [D]
        most: The longest allowed; also where a channel never moves by itself, but has to.
    """
    still = np.where(apart > 0, np.inf, 0.0)
    needed = PEAK * float(np.divide(apart, speed, out=still, where=speed > 0).max())
    return min(max(math.ceil(needed), SHORTEST), most) if needed < most else most
