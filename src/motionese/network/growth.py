"""Growth: a trained network gets a further, slower level and keeps what it has learned."""

import math

import equinox as eqx
from jaxtyping import Array

from motionese.errors import SettingError
from motionese.network.levels import Level
from motionese.network.mtrnn import MTRNN
from motionese.network.wiring import Scale


def grow(
    network: MTRNN,
    level: Level,
    *,
    key: Array,
    influence: float = 0.25,
    gain: float = 2.0,
    scale: Scale = "fan_in",
) -> MTRNN:
    """Open a further level above a network; every weight there was is kept.

    Args:
        network: The network as learned so far.
        level: The new level.
        key: JAX random key of the new weights.
        influence: Gain of the new level on the level below: its weights there are multiplied by
            it. With 0 the grown network computes the same bits as before, and still learns,
            because the weights' gradient depends on the new level's activity, not on the weights.
        gain: Gain of the initial weights, as for a network drawn whole.
        scale: Scale of the initial weights, as for a network drawn whole.

    Returns:
        The grown network, its new units last.
    """
    if not (math.isfinite(influence) and influence >= 0):
        raise SettingError(f"the influence of a new level must be ≥ 0, got {influence}")
    old = network.size
    drawn = MTRNN(
        [*network.levels, level],
        key=key,
        gain=gain,
        scale=scale,
        learned_bias=network.learned_bias,
        initial_io=network.initial_io,
        channels=network.channels,
    )
    grown: MTRNN = eqx.tree_at(
        lambda n: (n.weights, n.bias, n.tau),
        drawn,
        (
            drawn.weights.at[:old, old:].multiply(influence).at[:old, :old].set(network.weights),
            drawn.bias.at[:old].set(network.bias),
            drawn.tau.at[:old].set(network.tau),
        ),
    )
    return grown
