"""Initial states that motions share, level by level.

Motions of a group have one initial state of a level, which moves by the mean of their gradients.
The sum would be the gradient of one tied parameter; the mean moves it as far as a motion's own
initial state would move, however many experiences of a motion are remembered. With every update
rule of ours this is also the mean of the motions' own updates, had they begun where they do.

In batches of some motions it is the mean over those members of a group that are in the batch; the
others move along, so that a group has one state at any time.
"""

from collections.abc import Hashable, Mapping, Sequence

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float, Int

from motionese.errors import SettingError, unknown
from motionese.network import MTRNN

Groups = Mapping[str, Sequence[Hashable] | str]
"""By level: which group every motion belongs to; the members of a group share its states."""


def averaging(
    network: MTRNN, groups: Groups, motions: int, count: int
) -> dict[str, Float[Array, "C C"]]:
    """Return by level the matrix that averages over each motion's group.

    Args:
        network: The network, for the names of its levels.
        groups: Whose initial states are shared; a level that is not named has none.
        motions: How many motions there are.
        count: How many there are with those that pad, which are alone.

    Raises:
        SettingError: A level without initial states, or another number of motions.
    """
    matrices = {}
    for level, members in groups.items():
        if level not in network.names[1:]:
            raise SettingError(unknown("context level of shared states", level, network.names[1:]))
        if len(members) != motions:
            raise SettingError(
                f"shared initial states of {level} name the groups of {len(members)} motions, "
                f"got {motions} motions"
            )
        same = np.eye(count)
        same[:motions, :motions] = [[one == other for other in members] for one in members]
        shares = same / same.sum(axis=1, keepdims=True)
        matrices[level] = jnp.asarray(shares, network.weights.dtype)
    return matrices


def shared_among(shares: Float[Array, "C C"], motions: Int[Array, " M"]) -> Float[Array, "M M"]:
    """Return the matrix that averages over those of each motion's group that are among these."""
    among = shares[motions][:, motions]
    return among / among.sum(axis=1, keepdims=True)


def averaged(
    network: MTRNN, values: Float[Array, "C N"], shared: Mapping[str, Float[Array, "C C"]]
) -> Float[Array, "C N"]:
    """Return values of motions' initial states, or of their gradients, as a group shares them."""
    for level, shares in shared.items():
        units = network.units(level)
        values = values.at[:, units].set(shares @ values[:, units])
    return values
