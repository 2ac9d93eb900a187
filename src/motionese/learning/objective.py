"""What a network predicts of motions: the channels they share, where it starts, what follows."""

from dataclasses import replace

import jax.numpy as jnp
from jaxtyping import Array, Float

from motionese.errors import SettingError
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.motions import Motions
from motionese.network import MTRNN, Prediction, predict


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


def inputs(
    network: MTRNN,
    batch: Batch,
    free: Float[Array, "S N"],
    teacher_forcing: float | Float[Array, ""] = 0.0,
) -> tuple[Float[Array, "S N"], Float[Array, "S T D"], Float[Array, "S T D"]]:
    """Return what a rollout takes: where it starts, what is sensed, and its share of the inputs.

    Args:
        network: The network.
        batch: The motions.
        free: Initial states, see `initial_potentials`.
        teacher_forcing: Share of the sensed value in the inputs, where it was observed. The first
            row's input is what was sensed in any case: it is known before the first prediction.
    """
    share = (batch.observed * teacher_forcing).at[:, 0].set(batch.observed[:, 0])
    return initial_potentials(network, batch, free), batch.sensed, share


def predictions(
    network: MTRNN,
    batch: Batch,
    free: Float[Array, "S N"],
    teacher_forcing: float | Float[Array, ""] = 0.0,
    noise: Float[Array, "S T N"] | None = None,
) -> Prediction:
    """Predict every row of the motions from the rows before it; arguments as of `inputs`."""
    return predict(network, *inputs(network, batch, free, teacher_forcing), noise)


def with_shared_channels(network: MTRNN, motions: Motions) -> tuple[MTRNN, Motions]:
    """Return a network that carries channels, and the motions scaled by exactly these.

    A network that carries channels keeps them: motions read later, whose ranges may have been
    taken from their own data, are scaled as those it was trained on. One without takes the
    motions'.

    Raises:
        SettingError: The names differ, or there is not one IO unit per channel.
    """
    if network.channels is not None and network.channels.names != motions.channels.names:
        raise SettingError(
            f"the network's channels are {', '.join(network.channels.names)}, "
            f"the motions' {', '.join(motions.channels.names)}"
        )
    if network.io_size != len(motions.channels):
        raise SettingError(
            f"the network has {network.io_size} IO units, "
            f"the motions {len(motions.channels)} channels"
        )
    if network.channels is None:
        return replace(network, channels=motions.channels), motions
    return network, motions.scaled_by(network.channels)
