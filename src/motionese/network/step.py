"""One step of equations (1) and (2): what a rollout repeats and a robot takes one by one.

With ε_i = 1/τ_i, y = sigmoid(u), s what is sensed and m its share of the input,

    x = m s + (1 − m) y  (IO),    x = y  (context),
    u ← (1 − ε) u + ε (W x + b).
"""

from collections.abc import Callable

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.network.mtrnn import MTRNN

LANES = 16
"""Units are padded to a multiple of this many, twice it at least: then the products of a network,
and of the same network with further units of no influence, run through the same vector code and
come to the same bits. (Smaller products run through other code, which sums in another order.)"""


@eqx.filter_jit
def step(
    network: MTRNN,
    potentials: Float[Array, "*batch N"],
    sensed: Float[Array, "*batch D"],
    share: float | Float[Array, "..."],
) -> Float[Array, "*batch N"]:
    """Return the potentials one step later, to the bits of a compiled rollout of two rows.

    Args:
        potentials: u of all units, of one state or of a batch.
        sensed: What is sensed now, in the unit interval; anything finite where `share` is 0.
        share: How much of an input is sensed, the rest being the network's own prediction: one
            for all, or an array that broadcasts to `sensed`.
    """
    weights, bias, tau = widened(network)
    u = jnp.pad(potentials.reshape(-1, network.size), ((0, 0), (0, tau.size - network.size)))
    sensed = sensed.astype(u.dtype)
    share = jnp.broadcast_to(jnp.asarray(share, u.dtype), sensed.shape)
    drive, gate = (part.reshape(len(u), tau.size) for part in mixture(sensed, share, tau.size))
    following = advance(u, drive, gate, *per_step(weights, bias, tau))
    return following[:, : network.size].reshape(potentials.shape)


def stepper(network: MTRNN) -> Callable[[ndarray, ndarray, float], ndarray]:
    """Return `step` for one state [N] of a network that is stepped often, such as by a robot.

    What it takes is a state, what is sensed [D], and its share; what it holds of the network is
    worked out once.
    """
    constants = per_step(*widened(network))
    dtype = constants[0].dtype

    def stepped(potentials: ndarray, sensed: ndarray, share: float) -> ndarray:
        u, now, part = (np.asarray(value, dtype) for value in (potentials, sensed, share))
        return np.asarray(_stepped(constants, u, now, part))

    return stepped


@jax.jit
def _stepped(constants: tuple[Array, Array, Array], u: Array, sensed: Array, share: Array) -> Array:
    units = constants[0].size
    drive, gate = mixture(sensed, jnp.broadcast_to(share, sensed.shape), units)
    wide = jnp.pad(u, (0, units - u.size))[None]
    return advance(wide, drive, gate, *constants)[0, : u.size]


def widened(network: MTRNN) -> tuple[Array, Array, Array]:
    """Return weights, bias and time constants with further units that do nothing, see `LANES`."""
    idle = max(-network.size % LANES, 2 * LANES - network.size)
    return (
        jnp.pad(network.wired_weights(), (0, idle)),
        jnp.pad(network.bias, (0, idle)),
        jnp.pad(network.tau, (0, idle), constant_values=1.0),
    )


def per_step(weights: Array, bias: Array, tau: Array) -> tuple[Array, Array, Array]:
    """Return what equation (1) multiplies and adds at every step: 1 − ε, (ε W)ᵀ, ε b."""
    rate = 1 / tau
    return 1 - rate, (rate[:, None] * weights).T, rate * bias


def mixture(sensed: Array, share: Array, units: int) -> tuple[Array, Array]:
    """Return m s and 1 − m, widened from the IO units [..., D] to all units: 0 and 1 of context."""
    width = [(0, 0)] * (sensed.ndim - 1) + [(0, units - sensed.shape[-1])]
    return jnp.pad(share * sensed, width), jnp.pad(1 - share, width, constant_values=1.0)


def advance(
    u: Array, drive: Array, gate: Array, keep: Array, scaled: Array, offset: Array
) -> Array:
    """Take the step: `drive` and `gate` of `mixture`, the others of `per_step`."""
    x = drive + gate * jax.nn.sigmoid(u)
    return keep * u + x @ scaled + offset
