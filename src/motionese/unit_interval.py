"""The unit interval, in which the network's outputs live, and values in it. Needs NumPy only.

IO units are sigmoids, so a channel's range is mapped to 0.1–0.9 and whatever lies beyond it is
clipped to 0.02–0.98, where a logit is still finite and a gradient still flows.
"""

import numpy as np
from numpy import ndarray

INNER_LOW, INNER_HIGH = 0.1, 0.9
"""Where a channel's range lies in the unit interval."""
CLIP_LOW, CLIP_HIGH = 0.02, 0.98
"""Limits of every value in the unit interval, targets and inputs alike."""


def to_unit(values: ndarray, low: ndarray, span: ndarray) -> ndarray:
    """Map values [*shape, D] in the channels' units, which lie in [low, low + span], clipped."""
    share = (values - low) / span
    return np.asarray(np.clip(INNER_LOW + (INNER_HIGH - INNER_LOW) * share, CLIP_LOW, CLIP_HIGH))


def from_unit(values: ndarray, low: ndarray, span: ndarray) -> ndarray:
    """Map the unit interval [*shape, D] back to the channels' units."""
    share = (np.asarray(values, dtype=np.float64) - INNER_LOW) / (INNER_HIGH - INNER_LOW)
    return np.asarray(low + span * share)


def sigmoid(u: ndarray, out: ndarray | None = None) -> ndarray:
    """Equation (2): y = 1 / (1 + e^−u), written into `out` if given."""
    y = np.negative(u, out=out)
    with np.errstate(over="ignore"):  # of a potential far below 0, whose y is 0
        np.exp(y, out=y)
    np.add(y, 1, out=y)
    return np.asarray(np.divide(1, y, out=y))


def logit(y: ndarray) -> ndarray:
    """Return the potential whose output is y, for 0 < y < 1."""
    return np.asarray(np.log(y / (1 - y)))
