"""Equation (3): the summed squared error of predictions, and what the network starts from."""

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from motionese.learning.batch import Batch
from motionese.network import MTRNN, rollout


def initial_potentials(
    network: MTRNN, batch: Batch, free: Float[Array, "S N"]
) -> Float[Array, "S N"]:
    """Return u_0: context units (and IO units not observed at first) as given, IO as sensed.

    Args:
        network: Its `initial_io` says whether an observed IO unit starts from the logit of its
            first sensed value or every IO unit from 0.
        batch: The motions.
        free: Initial states that training and recognition move.
    """
    io = network.io_size
    if network.initial_io == "zero":
        return free.at[:, :io].set(0.0)
    first = jnp.log(batch.sensed[:, 0]) - jnp.log1p(-batch.sensed[:, 0])
    return free.at[:, :io].set(jnp.where(batch.observed[:, 0] > 0, first, free[:, :io]))


def predictions(
    network: MTRNN,
    batch: Batch,
    free: Float[Array, "S N"],
    teacher_forcing: float | Float[Array, ""],
    noise: Float[Array, "S T N"] | None = None,
) -> Float[Array, "S T D"]:
    """Predict every row of the motions from the rows before it.

    Args:
        network: The network.
        batch: The motions.
        free: Initial states, see `initial_potentials`.
        teacher_forcing: Share of the sensed value in the inputs, where it was observed. The first
            row's input is what was sensed in any case: it is known before the first prediction.
        noise: Added to the potentials.
    """
    share = (batch.observed * teacher_forcing).at[:, 0].set(batch.observed[:, 0])
    start = initial_potentials(network, batch, free)
    potentials = rollout(network, start, batch.sensed, share, noise)
    return jax.nn.sigmoid(potentials[..., : network.io_size])


def squared_errors(predicted: Float[Array, "S T D"], batch: Batch) -> Float[Array, " S"]:
    """Equation (3), summed by weight over every motion; row 0 predicts nothing."""
    return (((predicted - batch.sensed) ** 2) * batch.weight)[:, 1:].sum((1, 2))
