"""Which units are wired, and the weights a block of the wiring starts with.

A level is wired to itself and to its neighbours only: no weight leads from IO to Cs or back
(Yamashita & Tani 2008; Mochizuki et al. 2013, section III).
"""

from typing import Literal, get_args

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float
from numpy import ndarray

from motionese.errors import SettingError, unknown

Scale = Literal["fan_in", "one"]


def wiring(sizes: tuple[int, ...]) -> Bool[ndarray, "N N"]:
    """Return which weights w_ij exist: those inside a level and between neighbouring levels."""
    level = np.repeat(np.arange(len(sizes)), sizes)
    return np.asarray(np.abs(level[:, None] - level[None, :]) <= 1)


def weight_scales(sizes: tuple[int, ...], gain: float, scale: Scale) -> Float[ndarray, "N N"]:
    """Return the standard deviation every initial weight is drawn with, 0 where nothing is wired.

    Args:
        sizes: Units per level.
        gain: Multiplies every scale. A sigmoid's slope is at most 1/4, so a gain near 4 is what
            gives a level dynamics of its own; with 1 its activity dies away.
        scale: `"fan_in"`: gain / √(units of the sending level), block by block, so that two Cs
            units move Cf as much as forty Cf units do. `"one"`: gain / √(units of the largest
            level) for all blocks.
    """
    if scale not in get_args(Scale):
        raise SettingError(unknown("scale of the initial weights", scale, get_args(Scale)))
    counted = sizes if scale == "fan_in" else (max(sizes),) * len(sizes)
    senders = np.repeat(np.asarray(counted, dtype=np.float64), sizes)
    return np.asarray(wiring(sizes) * gain / np.sqrt(senders)[None, :])


def draw_weights(
    sizes: tuple[int, ...], gain: float, scale: Scale, key: Array, kept: int = 0
) -> Float[Array, "N N"]:
    """Draw initial weights from N(0, scale²) on the wiring.

    Every block has a key of its own: with the same key a network of two levels and one of three
    have the same deviates in the blocks they share. Blocks among the first `kept` levels are left
    0, not drawn.
    """

    def block(i: int, j: int) -> Array:
        shape = (sizes[i], sizes[j])
        if i < kept and j < kept:
            return jnp.zeros(shape)
        return jax.random.normal(jax.random.fold_in(jax.random.fold_in(key, i), j), shape)

    places = range(len(sizes))
    deviates = jnp.block([[block(i, j) for j in places] for i in places])
    return deviates * jnp.asarray(weight_scales(sizes, gain, scale), dtype=deviates.dtype)
