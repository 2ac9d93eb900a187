"""The actions that recordings of states imply: where to be in the next row."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray


def next_rows(states: Float[ndarray, "T D"]) -> Float[ndarray, "T D"]:
    """Return every row's successor; the last row is its own, for the motion ends there."""
    return np.concatenate([states[1:], states[-1:]])
