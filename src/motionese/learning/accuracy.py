"""How well a network predicts motions: in the channels' units, and as shares of their ranges."""

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.channels import Channels
from motionese.learning.motions.batch import Batch
from motionese.learning.objective import predictions
from motionese.network import MTRNN


def predicted(
    network: MTRNN, batch: Batch, initial: Float[Array | ndarray, "S N"], teacher_forcing: float
) -> Float[ndarray, "S T D"]:
    """Predict every row of a batch in the unit interval, from the initial states and row 0 on.

    `teacher_forcing` is 0 in closed loop, 1 with what was sensed as the input of every step.
    """
    share = jnp.asarray(teacher_forcing, network.weights.dtype)
    return np.asarray(_predicted(network, batch, jnp.asarray(initial), share))


@eqx.filter_jit
def _predicted(network: MTRNN, batch: Batch, initial: Array, share: Array) -> Array:
    return predictions(network, batch, initial, share).mean


def errors_of(
    network: MTRNN, batch: Batch, initial: Float[Array | ndarray, "S N"], teacher_forcing: float
) -> Float[ndarray, "S D"]:
    """Return every motion's root mean squared error in the units of the network's channels."""
    assert network.channels is not None, "a network that is trained carries channels"
    rows = predicted(network, batch, initial, teacher_forcing)
    return channel_errors(rows, batch, network.channels)


def channel_errors(
    predicted: Float[ndarray, "S T D"], batch: Batch, channels: Channels
) -> Float[ndarray, "S D"]:
    """Return every motion's root mean squared error in the channels' units.

    A channel that is observed nowhere after the first row has the error NaN: it is not known.
    """
    observed = np.asarray(batch.observed)[:, 1:]
    squared = ((predicted - np.asarray(batch.sensed))[:, 1:] ** 2 * observed).sum(1)
    counted = observed.sum(1)
    mean = np.divide(squared, counted, out=np.full(squared.shape, np.nan), where=counted > 0)
    return np.asarray(np.sqrt(mean) * channels.interval_widths)


def share_of_range(errors: Float[ndarray, "*batch D"], channels: Channels) -> float:
    """Return errors in the channels' units as one share of range: the root of their mean square.

    Errors that are not known (NaN) do not count; NaN if none is known.
    """
    shares = errors / channels.spans
    known = shares[~np.isnan(shares)]
    return float(np.sqrt((known**2).mean())) if len(known) else float("nan")
