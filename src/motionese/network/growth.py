"""Growth: a trained network gets a further, slower level and keeps what it has learned."""

import math
from dataclasses import replace

import jax.numpy as jnp
from jaxtyping import Array

from motionese.arguments import refusing
from motionese.errors import SettingError
from motionese.network.levels import Level, named
from motionese.network.mtrnn import MTRNN
from motionese.network.trained import Trained, network_of
from motionese.network.wiring import Scale, draw_weights


@refusing()
def grow(
    network: MTRNN | Trained,
    level: Level,
    *,
    key: Array,
    influence: float = 0.25,
    gain: float = 2.0,
    scale: Scale = "fan_in",
) -> MTRNN:
    """Open a further level above a network; every weight there was is kept.

    Args:
        network: The network as learned so far, or what training left of it.
        level: The new level; its units are the grown network's last.
        key: JAX random key of the new weights.
        influence: Gain of the new level on the level below: its weights there are multiplied by
            it. With 0 the grown network computes the same bits as before, and still learns,
            because the weights' gradient depends on the new level's activity, not on the weights.
        gain: Gain of the initial weights, as for a network drawn whole; so is `scale`.
    """
    if not (math.isfinite(influence) and influence >= 0):
        raise SettingError(f"the influence of a new level must be ≥ 0, got {influence}")
    network = network_of(network)
    old, sizes, read_out = network.size, (*network.sizes, level.size), network.variance_weights
    opened = named([*network.levels, level])[-1]
    drawn = draw_weights(sizes, gain, scale, key, kept=len(network.sizes))
    drawn = drawn.at[:old, old:].multiply(influence)
    return replace(
        network,
        names=(*network.names, opened.name),
        sizes=sizes,
        weights=drawn.at[:old, :old].set(network.weights),
        bias=jnp.pad(network.bias, (0, level.size)),
        tau=jnp.append(network.tau, jnp.asarray(opened.taus, network.tau.dtype)),
        variance_weights=None if read_out is None else jnp.pad(read_out, ((0, 0), (0, level.size))),
    )
