"""How a rollout's predictions change with its initial states: sensitivities, forward in time.

With x_t = m_t s_t + k_t y_t as in `rollout` and S_t = ∂u_t/∂u_0, a step of equation (1) gives

    S_0 = 1,    S_{t+1} = (1 − ε) S_t + ε W (k_t y_t (1 − y_t) S_t),

and ∂y_t/∂u_0 = y_t (1 − y_t) S_t. One scan carries u and S, and needs nothing of the past.
"""

from typing import Any

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from motionese.network.mtrnn import MTRNN
from motionese.network.step import advance, mixture, per_step, widened


def sensitivities(
    network: MTRNN,
    initial: Float[Array, "B N"],
    sensed: Float[Array, "B T D"],
    share: Float[Array, "B T D"],
    units: Int[Array, " K"],
) -> tuple[Float[Array, "B T N"], Float[Array, "B T K D"]]:
    """Return the potentials of a rollout, and ∂y_t/∂u_0 of its predictions for some units' u_0.

    Args:
        network: The network.
        initial: As of `rollout`, like what follows.
        sensed: Sensed values in the unit interval.
        share: How much of an input is sensed.
        units: Which K units' initial potentials may change.
    """
    weights, bias, tau = widened(network)
    io = network.io_size
    keep, scaled, offset = per_step(weights, bias, tau)
    drive, gate = mixture(jnp.swapaxes(sensed, 0, 1), jnp.swapaxes(share, 0, 1), tau.size)

    def step(carry: tuple[Array, Array], mixed: tuple[Array, Array]) -> tuple[Any, Any]:
        u, change = carry
        drive_t, gate_t = mixed
        y = jax.nn.sigmoid(u)
        slope = y * (1 - y)
        later = advance(u, drive_t, gate_t, keep, scaled, offset)
        changed = keep * change + ((gate_t * slope)[:, None] * change) @ scaled
        return (later, changed), (u, slope[:, None, :io] * change[..., :io])

    initial = jnp.pad(initial, ((0, 0), (0, tau.size - network.size)))
    one = jnp.zeros((len(units), tau.size), initial.dtype).at[jnp.arange(len(units)), units].set(1)
    begin = (initial, jnp.broadcast_to(one, (len(initial), *one.shape)))
    _, (potentials, jacobian) = jax.lax.scan(step, begin, (drive, gate))
    return jnp.swapaxes(potentials, 0, 1)[..., : network.size], jnp.swapaxes(jacobian, 0, 1)
