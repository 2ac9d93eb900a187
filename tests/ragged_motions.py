"""Motions of different lengths, with gaps and weights, and networks that fit them."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np

from motionese import MTRNN, Channel, Channels, Level, Motions

CHANNELS = Channels([Channel("x", "cm", -2.0, 2.0), Channel("y", "cm", 0.0, 5.0)])
LENGTHS = (6, 4, 7)
SIZES = {2: (2, 5), 3: (2, 4, 2), 4: (2, 3, 2, 1)}


def drawn(levels, **settings):
    """A network with a bias, and the same as arrays by name for the twin."""
    sizes = SIZES[levels]
    net = MTRNN.draw(
        [Level(size, tau) for size, tau in zip(sizes, (2.0, 5.0, 30.0, 70.0), strict=False)],
        key=jax.random.key(levels),
        channels=CHANNELS,
        **settings,
    )
    net = replace(net, bias=jnp.linspace(-0.5, 0.5, net.size))
    arrays = {name: np.asarray(getattr(net, name)) for name in ("weights", "bias", "tau")}
    return net, {**arrays, "sizes": sizes, **settings}


def small_network():
    """A network whose variance depends on its context."""
    levels = [Level(2, 2.0), Level(3, 5.0), Level(2, 30.0)]
    net = MTRNN.draw(levels, key=jax.random.key(0), channels=CHANNELS, variance=True)
    read = jax.random.normal(jax.random.key(1), (2, 5))
    return replace(net, bias=jnp.linspace(-0.5, 0.5, 7), variance_weights=read)


def ragged():
    """Motions with gaps and weights, as Motions and in the unit interval for the twin."""
    rng = np.random.default_rng(0)
    values = [rng.uniform((-2.0, 0.0), (2.0, 5.0), (length, 2)) for length in LENGTHS]
    masks = [rng.uniform(size=value.shape) < 0.7 for value in values]
    masks[0][0] = (True, False)
    weights = [rng.uniform(0.0, 2.0, value.shape) for value in values]
    motions = Motions.from_arrays(values, CHANNELS, 10.0, observed=masks, weights=weights)
    scaled = [0.1 + 0.8 * (value - (-2.0, 0.0)) / (4.0, 5.0) for value in values]
    return motions, list(zip(scaled, masks, weights, strict=True))
