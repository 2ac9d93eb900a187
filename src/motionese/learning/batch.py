"""Motions of different lengths as one array, padded by nothing that has a meaning."""

from collections.abc import Sequence
from typing import NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray


class Batch(NamedTuple):
    """Motions as the network takes them, padded to one length.

    Attributes:
        sensed: Values in the unit interval; 0.5 where nothing was observed.
        observed: 1 where a value was observed, 0 where not or where a motion has ended.
    """

    sensed: Float[Array, "S T D"]
    observed: Float[Array, "S T D"]


def padded(unit: Sequence[ndarray], masks: Sequence[ndarray], rows: int, count: int) -> Batch:
    """Return motions [T_i, D] in the unit interval as a batch of `count` motions of `rows`."""
    sensed = np.full((count, rows, unit[0].shape[1]), 0.5)
    observed = np.zeros(sensed.shape)
    for i, (value, mask) in enumerate(zip(unit, masks, strict=True)):
        sensed[i, : len(value)] = np.where(mask, value, 0.5)
        observed[i, : len(value)] = mask
    return Batch(jnp.asarray(sensed, jnp.result_type(float)), jnp.asarray(observed, float))
