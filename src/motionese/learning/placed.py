"""Starting where the robot actually is, not where the motion was recorded."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import ChannelError
from motionese.network import MTRNN


def placed(
    network: MTRNN, initial_state: Float[ndarray, "*batch N"], here: Mapping[str, float]
) -> Float[ndarray, "*batch N"]:
    """Return initial states of motions that begin where the robot is.

    The IO units of the channels that are given start from the logit of what is sensed, as in
    training; context units keep the motion. Those of a network whose `initial_io` is "zero" stay
    at 0: it takes up where the robot is as its first input alone, `first` of `generate`.

    Args:
        network: A network that carries channels.
        initial_state: u_0 of all levels, of one motion or of a batch.
        here: Where the robot is, by channel, in the channels' units.

    Raises:
        ChannelError: A channel that the network does not have, or a value that is not finite.
    """
    channels = network.channels
    if channels is None:
        raise ChannelError("the network carries no channels; train it on motions first")
    columns, values = channels.indices(here), np.full(len(channels), 0.0)
    values[columns] = list(here.values())
    wrong = [name for name, value in here.items() if not np.isfinite(value)]
    if wrong:
        raise ChannelError(
            f"channel '{wrong[0]}': where the robot is must be finite, got {here[wrong[0]]}"
        )
    states = np.array(initial_state)
    if network.initial_io == "sensed":
        unit = channels.to_unit(values)[columns]
        states[..., columns] = np.log(unit) - np.log1p(-unit)
    return states
