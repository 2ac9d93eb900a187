"""Channels that a network and motions share: whose scaling counts when both have their own."""

from dataclasses import replace

from motionese.errors import SettingError
from motionese.learning.motions import Motions
from motionese.network import MTRNN


def carried(network: MTRNN, motions: Motions) -> tuple[MTRNN, Motions]:
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
