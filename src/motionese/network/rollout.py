"""Whole rollouts of a batch in one scan, with the adjoint derived by hand.

With ε_i = 1/τ_i, y = sigmoid(u), and x the input vector (of an IO unit a mixture of what was
sensed and its own prediction, of a context unit its own y), equations (1) and (2) read

    x_t = m_t s_t + (1 − m_t) y_t  (IO),    x_t = y_t  (context)
    u_{t+1} = (1 − ε) u_t + ε (W x_t + b) + n_{t+1}.

With g_t = ∂E/∂u_t as handed in from outside and δ_t the total derivative, the adjoint runs back:

    p_t = Wᵀ (ε δ_{t+1}),     δ_t = g_t + (1 − ε) δ_{t+1} + y_t (1 − y_t) k_t p_t,

k_t being 1 − m_t for IO and 1 for context. The backward scan carries δ alone; every other gradient
is one contraction of the stacked δ afterwards, and one that nobody asks for is never computed:

    ∂E/∂W = Σ ε δ_{t+1} x_tᵀ     ∂E/∂b = Σ ε δ_{t+1}     ∂E/∂u_0 = δ_0     ∂E/∂n_t = δ_t
    ∂E/∂s_t = m_t p_t            ∂E/∂m_t = (s_t − y_t) p_t
    ∂E/∂τ = −Σ ε² δ_{t+1} (W x_t + b − u_t).
"""

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from motionese.network.mtrnn import MTRNN

LANES = 16
"""Units are padded to a multiple of this many, twice it at least: then the products of a network,
and of the same network with further units of no influence, run through the same vector code and
come to the same bits. (Smaller products run through other code, which sums in another order.)"""

Gradients = tuple[Array, Array, Array, Array, Array, Array, Array | None]
Saved = tuple[Array, Array, Array, Array, Array, Array, bool]


def rollout(
    network: MTRNN,
    initial: Float[Array, "B N"],
    sensed: Float[Array, "B T D"],
    share: Float[Array, "B T D"],
    noise: Float[Array, "B T N"] | None = None,
) -> Float[Array, "B T N"]:
    """Return the potentials u of a batch of sequences; `jax.nn.sigmoid` of them is y.

    `y[:, t, :D]` is the prediction of row t, made from rows before t. (Equation (3) labels a
    prediction by the step it is made at, we by the step it is about.)

    Args:
        network: The network.
        initial: Potentials at t = 0, all levels.
        sensed: Sensed values in the unit interval; what `share` never takes may be anything finite.
        share: How much of an input is sensed and how much the network's own prediction, from 1
            (teacher forcing) to 0 (closed loop), per channel and step. The last row is not used.
        noise: Added to the potentials, row t to u_t; the first row is not used.

    Returns:
        Potentials u_0 … u_{T−1}.
    """
    idle = max(-network.size % LANES, 2 * LANES - network.size)
    potentials = _rollout(
        jnp.pad(network.wired_weights(), (0, idle)),
        jnp.pad(network.bias, (0, idle)),
        jnp.pad(network.tau, (0, idle), constant_values=1.0),
        jnp.pad(initial, ((0, 0), (0, idle))),
        jnp.swapaxes(sensed, 0, 1),
        jnp.swapaxes(share, 0, 1),
        None if noise is None else jnp.pad(jnp.swapaxes(noise, 0, 1), ((0, 0), (0, 0), (0, idle))),
    )
    return jnp.swapaxes(potentials[..., : network.size], 0, 1)


@jax.custom_vjp
def _rollout(
    weights: Array,
    bias: Array,
    tau: Array,
    initial: Array,
    sensed: Array,
    share: Array,
    noise: Array | None,
) -> Array:
    """Run equation (1), time first: initial [B, N], sensed and share [T, B, D] → u [T, B, N]."""
    rate = 1 / tau
    drive, gate = _padded(share * sensed, 0.0, tau.size), _padded(1 - share, 1.0, tau.size)
    scaled = (rate[:, None] * weights).T
    offset = rate * bias

    def step(u: Array, inputs: tuple[Array, Array, Array | None]) -> tuple[Array, Array]:
        drive_t, gate_t, noise_t = inputs
        x = drive_t + gate_t * jax.nn.sigmoid(u)
        following = (1 - rate) * u + x @ scaled + offset
        if noise_t is not None:
            following = following + noise_t
        return following, following

    steps = (drive[:-1], gate[:-1], None if noise is None else noise[1:])
    _, later = jax.lax.scan(step, initial, steps)
    return jnp.concatenate([initial[None], later])


def _forward(
    weights: Array,
    bias: Array,
    tau: Array,
    initial: Array,
    sensed: Array,
    share: Array,
    noise: Array | None,
) -> tuple[Array, Saved]:
    potentials = _rollout(weights, bias, tau, initial, sensed, share, noise)
    return potentials, (weights, bias, tau, sensed, share, potentials, noise is not None)


def _backward(saved: Saved, outer: Array) -> Gradients:
    weights, bias, tau, sensed, share, potentials, has_noise = saved
    rate, units = 1 / tau, tau.size
    y = jax.nn.sigmoid(potentials)
    gate = _padded(1 - share, 1.0, units)
    slope = gate * y * (1 - y)
    scaled = rate[:, None] * weights

    def step(delta: Array, inputs: tuple[Array, Array]) -> tuple[Array, Array]:
        outer_t, slope_t = inputs
        earlier = outer_t + (1 - rate) * delta + slope_t * (delta @ scaled)
        return earlier, earlier

    _, earlier = jax.lax.scan(step, outer[-1], (outer[:-1], slope[:-1]), reverse=True)
    deltas = jnp.concatenate([earlier, outer[-1:]])
    later = deltas[1:]
    error = rate * later
    x = (_padded(share * sensed, 0.0, units) + gate * y)[:-1]
    reached = (later @ scaled)[..., : sensed.shape[-1]]
    last = jnp.zeros_like(sensed[:1])
    slack = jnp.einsum("tbj,ij->tbi", x, weights) + bias - potentials[:-1]
    return (
        jnp.einsum("tbi,tbj->ij", error, x),
        error.sum((0, 1)),
        -(rate * error * slack).sum((0, 1)),
        deltas[0],
        jnp.concatenate([share[:-1] * reached, last]),
        jnp.concatenate([(sensed - y[..., : sensed.shape[-1]])[:-1] * reached, last]),
        jnp.concatenate([jnp.zeros_like(outer[:1]), later]) if has_noise else None,
    )


def _padded(io: Array, context: float, units: int) -> Array:
    """Widen an array over the IO units [T, B, D] to all units, with a constant for context."""
    return jnp.pad(io, ((0, 0), (0, 0), (0, units - io.shape[-1])), constant_values=context)


_rollout.defvjp(_forward, _backward)
