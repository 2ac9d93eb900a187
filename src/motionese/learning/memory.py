"""Memory: the motions that a network has learned, from which recognition starts.

Few channels do not tell a motion from random starts; the learned motions nearest to what is
observed do. How well they were learned tells when a recognition has come near enough.
"""

from dataclasses import dataclass
from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.learning.error import error_of
from motionese.learning.motions.batch import Batch
from motionese.learning.objective import predictions
from motionese.network import MTRNN

RECALLED = 4
"""So many learned motions are recalled: those nearest to what is observed."""
SLACK = 1.1
"""A motion shown again is as well recognised as it was learned if its error is within this."""
SMALLEST = 4
"""A memory is compared as if it held a power of two of motions, and so many at least: one that
gains a motion then seldom needs code that is compiled anew."""


class Recall(NamedTuple):
    """Learned motions as starts of recognition, the nearest first.

    Attributes:
        starts: Their initial states. [S, M, N]
        enough: The loss with which such a start is as near as the motion was learned. [S, M]
        typical: The same for any other start: as near as half of the motions were learned. [S]
    """

    starts: Float[ndarray, "S M N"]
    enough: Float[ndarray, "S M"]
    typical: Float[ndarray, " S"]


@dataclass(frozen=True)
class Memory:
    """Motions that a network has learned.

    Attributes:
        names: Their names.
        initial_states: Their u_0, all levels. [K, N]
        errors: Root mean squared error of each in closed loop, each channel in its unit; NaN
            where it is not known. [K, D]
    """

    names: tuple[str, ...]
    initial_states: Float[ndarray, "K N"]
    errors: Float[ndarray, "K D"]

    def nearest(self, network: MTRNN, batch: Batch, count: int = RECALLED) -> Recall:
        """Recall for every motion of a batch the learned ones nearest to what is observed.

        Args:
            network: The network that learned them; it carries channels.
            batch: What is observed.
            count: How many are recalled of each, at most.
        """
        known = len(self.names)
        idle = max(SMALLEST, 1 << (known - 1).bit_length()) - known
        learned, squared = (
            jnp.asarray(np.pad(values, ((0, idle), (0, 0))), network.weights.dtype)
            for values in (self.initial_states, self._squared(network) * SLACK**2)
        )
        each = [_losses(network, Batch(*one), learned, squared) for one in zip(*batch, strict=True)]
        losses, expected = (np.stack(part)[:, :known] for part in zip(*each, strict=True))
        nearest = np.argsort(losses, kind="stable")[:, :count]
        return Recall(
            starts=self.initial_states[nearest],
            enough=np.take_along_axis(expected, nearest, axis=1),
            typical=np.median(expected, axis=1),
        )

    def _squared(self, network: MTRNN) -> Float[ndarray, "K D"]:
        """Return how well every motion was learned, in the unit interval, per row and channel."""
        assert network.channels is not None, "a network that is trained carries channels"
        shares = (self.errors / network.channels.interval_widths) ** 2
        known = np.where(np.isnan(shares).all(0), 0.0, shares)
        return np.asarray(
            np.where(np.isnan(shares), np.nan_to_num(np.nanmedian(known, axis=0)), shares)
        )


@eqx.filter_jit
def _losses(
    network: MTRNN, one: Batch, states: Float[Array, "K N"], squared: Float[Array, "K D"]
) -> tuple[Float[Array, " K"], Float[Array, " K"]]:
    """Return the errors of recalled motions, and those they would have as well as learned."""
    repeated = Batch(*(jnp.broadcast_to(part, (len(states), *part.shape)) for part in one))
    predicted, error = predictions(network, repeated, states, 0.0), error_of(network)
    expected = error.weighted(squared[:, None], predicted.variance, repeated.weight)
    return error(predicted, repeated), expected
