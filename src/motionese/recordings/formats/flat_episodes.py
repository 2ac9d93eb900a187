"""Where episodes that stand one after another in the same rows begin and end."""

import numpy as np
from jaxtyping import Shaped
from numpy import ndarray


def cuts(
    terminals: Shaped[ndarray, " N"] | None, timeouts: Shaped[ndarray, " N"] | None, count: int
) -> list[slice]:
    """Return the rows of every episode.

    Args:
        terminals: Not zero in every row in which an episode came to its end.
        timeouts: Not zero in every row in which one was stopped.
        count: Rows in all, N; those after the last end are an episode of their own.
    """
    ends = np.zeros(count, dtype=bool)
    for marks in (terminals, timeouts):
        if marks is not None:
            ends |= marks.astype(bool)
    stops = [*(np.flatnonzero(ends) + 1).tolist(), count]
    starts = [0, *stops]
    return [slice(a, b) for a, b in zip(starts, stops, strict=False) if a < b]
