"""Motions of different lengths as one array, padded by nothing that has a meaning."""

from typing import NamedTuple

from jaxtyping import Array, Float


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
