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
        observed: Gate of the input: 1 where a value was observed, 0 where not or where a motion
            has ended.
        weight: Weight of the error: how much a value counts; 0 where it was not observed.
    """

    sensed: Float[Array, "S T D"]
    observed: Float[Array, "S T D"]
    weight: Float[Array, "S T D"]


def padded(
    unit: Sequence[ndarray],
    masks: Sequence[ndarray],
    weights: Sequence[ndarray],
    rows: int,
    count: int,
) -> Batch:
    """Return motions [T_i, D] in the unit interval as a batch of `count` motions of `rows`."""
    sensed = np.full((count, rows, unit[0].shape[1]), 0.5)
    observed, weight = np.zeros(sensed.shape), np.zeros(sensed.shape)
    for i, (value, mask, counts) in enumerate(zip(unit, masks, weights, strict=True)):
        sensed[i, : len(value)] = np.where(mask, value, 0.5)
        observed[i, : len(value)] = mask
        weight[i, : len(value)] = mask * counts
    kind = jnp.result_type(float)
    return Batch(*(jnp.asarray(part, kind) for part in (sensed, observed, weight)))
