"""Recall: recognition starts from what was learned, and knows how well that was learned."""

from typing import NamedTuple

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.learning.batch import Batch
from motionese.learning.fit import Fit
from motionese.learning.objective import predictions, squared_errors
from motionese.network import MTRNN

RECALLED = 4
"""So many learned motions are recalled: those nearest to what is observed."""
SLACK = 1.1
"""A motion shown again is as well recognised as it was learned if its error is within this."""


class Recalled(NamedTuple):
    """Starts from learned motions.

    Attributes:
        starts: Their initial states. [S, M, N]
        enough: The loss with which such a start is as near as the motion was learned. [S, M]
        typical: The same for any other start: as near as half of the motions were learned. [S]
    """

    starts: Float[ndarray, "S M N"]
    enough: Float[ndarray, "S M"]
    typical: Float[ndarray, " S"]


def recalled(fit: Fit, batch: Batch) -> Recalled:
    """Recall for every motion of a batch the learned ones that are nearest to what is observed."""
    learned = jnp.asarray(fit.initial_states, fit.network.weights.dtype)
    nearest = np.stack(
        [
            np.argsort(np.asarray(_losses(fit.network, Batch(*one), learned)), kind="stable")
            for one in zip(*batch, strict=True)
        ]
    )[:, :RECALLED]
    counted = np.asarray(batch.weight)[:, 1:].sum(1)
    expected = counted @ _squared_errors(fit).T * SLACK**2
    return Recalled(
        starts=fit.initial_states[nearest],
        enough=np.take_along_axis(expected, nearest, axis=1),
        typical=np.median(expected, axis=1),
    )


@eqx.filter_jit
def _losses(network: MTRNN, one: Batch, states: Float[Array, "K N"]) -> Float[Array, " K"]:
    repeated = Batch(*(jnp.broadcast_to(part, (len(states), *part.shape)) for part in one))
    return squared_errors(predictions(network, repeated, states, 0.0), repeated)


def _squared_errors(fit: Fit) -> Float[ndarray, "K D"]:
    """Return how well every motion was learned, in the unit interval, per row and channel."""
    assert fit.network.channels is not None, "a trained network carries channels"
    shares = (fit.closed_loop_error / fit.network.channels.interval_widths) ** 2
    typical = np.nan_to_num(np.nanmedian(np.where(np.isnan(shares).all(0), 0.0, shares), axis=0))
    return np.asarray(np.where(np.isnan(shares), typical, shares))
