"""Whole rollouts of a batch in one loop, with the adjoint derived by hand.

With ε_i = 1/τ_i, y = sigmoid(u) and x the input vector, row t + 1 follows from row t by a step (see
`step`) and noise:

    x_t = m_t s_t + (1 − m_t) y_t  (IO),    x_t = y_t  (context)
    u_{t+1} = (1 − ε) u_t + ε (W x_t + b) + n_{t+1}.

With g_t = ∂E/∂u_t as handed in from outside and δ_t the total derivative, the adjoint runs back:

    p_t = Wᵀ (ε δ_{t+1}),     δ_t = g_t + (1 − ε) δ_{t+1} + y_t (1 − y_t) k_t p_t,

k_t being 1 − m_t for IO and 1 for context. The backward loop carries δ alone; every other gradient
is one contraction of the stacked δ afterwards, and one that nobody asks for is never computed:

    ∂E/∂W = Σ ε δ_{t+1} x_tᵀ     ∂E/∂b = Σ ε δ_{t+1}     ∂E/∂u_0 = δ_0     ∂E/∂n_t = δ_t
    ∂E/∂s_t = m_t p_t            ∂E/∂m_t = (s_t − y_t) p_t
    ∂E/∂τ = −Σ ε² δ_{t+1} (W x_t + b − u_t).
"""

from typing import Any

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from motionese.network.mtrnn import MTRNN
from motionese.network.step import advance, mixture, per_step, widened

Gradients = tuple[Array, Array, Array, Array, Array, Array, Array | None]
Saved = tuple[Array, Array, Array, Array, Array, Array, bool]


def rollout(
    network: MTRNN,
    initial: Float[Array, "B N"],
    sensed: Float[Array, "B T D"],
    share: Float[Array, "B T D"],
    noise: Float[Array, "B T N"] | None = None,
) -> Float[Array, "B T N"]:
    """Return the potentials u_0 … u_{T−1} of a batch of sequences; `jax.nn.sigmoid` of them is y.

    `y[:, t, :D]` is the prediction of row t, made from rows before t. (Equation (3) labels a
    prediction by the step it is made at, we by the step it is about.)

    Args:
        initial: Potentials at t = 0, all levels.
        sensed: Sensed values in the unit interval; what `share` never takes may be anything finite.
        share: How much of an input is sensed and how much the network's own prediction, from 1
            (teacher forcing) to 0 (closed loop), per channel and step. The last row is not used.
        noise: Added to the potentials, row t to u_t; the first row is not used.
    """
    weights, bias, tau = widened(network)
    idle = tau.size - network.size
    widen = [(0, 0), (0, idle)]
    if noise is not None:
        noise = jnp.pad(jnp.swapaxes(noise, 0, 1), [(0, 0), *widen])
    by_time = (jnp.swapaxes(sensed, 0, 1), jnp.swapaxes(share, 0, 1), noise)
    potentials = _rollout(weights, bias, tau, jnp.pad(initial, widen), *by_time)
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
    drive, gate = mixture(sensed, share, tau.size)
    constants = per_step(weights, bias, tau)

    def step(t: Array, potentials: Array) -> Array:
        following = advance(_row(potentials, t), _row(drive, t), _row(gate, t), *constants)
        if noise is not None:
            following = following + _row(potentials, t + 1)
        return _with_row(potentials, t + 1, following)

    # Each row takes the place of its noise; a scan that stacks rows would copy every one.
    rows = jnp.zeros((len(sensed), *initial.shape), initial.dtype) if noise is None else noise
    potentials: Array = jax.lax.fori_loop(0, len(rows) - 1, step, rows.at[0].set(initial))
    return potentials


def _row(rows: Array, t: Array) -> Array:
    row: Array = jax.lax.dynamic_index_in_dim(rows, t, keepdims=False, allow_negative_indices=False)
    return row


def _with_row(rows: Array, t: Array, row: Array) -> Array:
    updated: Array = jax.lax.dynamic_update_index_in_dim(
        rows, row, t, 0, allow_negative_indices=False
    )
    return updated


def _forward(*inputs: Any) -> tuple[Array, Saved]:
    weights, bias, tau, _, sensed, share, noise = inputs
    potentials = _rollout(*inputs)
    return potentials, (weights, bias, tau, sensed, share, potentials, noise is not None)


def _backward(saved: Saved, outer: Array) -> Gradients:
    weights, bias, tau, sensed, share, potentials, has_noise = saved
    rate, y = 1 / tau, jax.nn.sigmoid(potentials)
    drive, gate = mixture(sensed, share, tau.size)
    slope = gate * y * (1 - y)
    scaled = rate[:, None] * weights

    def step(back: Array, deltas: Array) -> Array:
        t = len(outer) - 2 - back
        delta = _row(deltas, t + 1)
        earlier = _row(deltas, t) + (1 - rate) * delta + _row(slope, t) * (delta @ scaled)
        return _with_row(deltas, t, earlier)

    deltas = jax.lax.fori_loop(0, len(outer) - 1, step, outer)  # each δ_t takes the place of g_t
    later = deltas[1:]
    error = rate * later
    x = (drive + gate * y)[:-1]
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


_rollout.defvjp(_forward, _backward)
