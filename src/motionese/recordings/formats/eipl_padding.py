"""How many rows of an episode were recorded, where all are padded to the length of the longest.

The longest episode of an array is not padded: whatever its end looks like was recorded. So rows
that repeat an episode's last one are padding only beyond as many as every episode has, which then
are a rest; two and more rows of zeros only where not all end in them; rows of NaN always. The
trap: an episode that rests, to the last bit, for longer than the longest does, is cut.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray


def recorded_lengths(padded: Sequence[Float[ndarray, "_ D"]]) -> list[int]:
    """Return how many rows of every episode were recorded, up to the first of the padding.

    Episodes that are padded to different lengths, as they are in two folders, are no measure for
    one another.
    """
    lengths = [0] * len(padded)
    for rows in {len(values) for values in padded}:
        here = [i for i, values in enumerate(padded) if len(values) == rows]
        for i, length in zip(here, _of_one_length([padded[i] for i in here]), strict=True):
            lengths[i] = length
    return lengths


def _of_one_length(padded: Sequence[Float[ndarray, "T D"]]) -> list[int]:
    missing = [_last(np.isnan(values).all(axis=1)) for values in padded]
    zeros = [_last((values == 0).all(axis=1)) for values in padded]
    repeated = [_last(_as_last(values)) - 1 for values in padded]
    if any(missing):
        cut = missing
    elif _with_zeros(zeros, repeated):
        cut = zeros
    else:
        cut = [rows - min(repeated) for rows in repeated]
    return [len(values) - rows for values, rows in zip(padded, cut, strict=True)]


def _with_zeros(zeros: Sequence[int], repeated: Sequence[int]) -> bool:
    """Tell whether rows of zeros explain more ends of episodes than repeated rows do."""
    others = [rows for rows, zero in zip(repeated, zeros, strict=True) if not zero]
    padded = len(zeros) - len(others)
    return bool(others) and max(zeros) > 1 and padded > sum(n > min(others) for n in others)


def _as_last(values: Float[ndarray, "T D"]) -> Bool[ndarray, " T"]:
    """Return which rows are the last one, to the last bit."""
    bits = np.ascontiguousarray(values).view(np.int64)
    return np.asarray((bits == bits[-1]).all(axis=1))


def _last(which: Bool[ndarray, " T"]) -> int:
    """Return how many rows at the end are such rows."""
    others = np.flatnonzero(~which)
    return len(which) - (int(others[-1]) + 1 if len(others) else 0)
