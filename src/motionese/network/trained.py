"""A network, or what training left of one: wherever a network is taken, so is what holds it."""

from typing import Protocol, runtime_checkable

from motionese.network.mtrnn import MTRNN


@runtime_checkable
class Trained(Protocol):
    """What holds a network, such as what training left."""

    @property
    def network(self) -> MTRNN:
        """The network."""


def network_of(given: MTRNN | Trained) -> MTRNN:
    """Return a network that was given, or the network of what training left."""
    return given if isinstance(given, MTRNN) else given.network
