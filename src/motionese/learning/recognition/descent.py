"""Equation (5) in recognition: the weights frozen, initial states descend from several starts."""

import equinox as eqx
import jax
import jax.numpy as jnp
import optax
from jaxtyping import Array, Float, Int

from motionese.learning.error import error_of
from motionese.learning.motions.batch import Batch
from motionese.learning.objective import initial_potentials, predictions
from motionese.network import MTRNN

_Descent = tuple[Array, optax.OptState, Array, Array, Array]
"""States, the update rule's memory, the best states so far, their loss, and updates taken."""


@eqx.filter_jit
def descend(
    network: MTRNN,
    batch: Batch,
    free: Float[Array, "S M N"],
    bound: Float[Array, " N"],
    rule: optax.GradientTransformation,
    penalty: Float[Array, ""],
    iterations: int,
    enough: Float[Array, "S M"] | None,
) -> tuple[Float[Array, "S N"], Float[Array, "S M"], Int[Array, " S"]]:
    """Descend from every start; return the chosen start's states, all losses, and which it is.

    Only the gradient of the initial states is asked for, so that of the weights is never computed.

    Args:
        network: The network.
        batch: The motions.
        free: Initial states to start from.
        bound: Largest |u_0|.
        rule: The update rule.
        penalty: Weight of Σ u_0².
        iterations: Updates at most.
        enough: A start whose loss is as small as this stays where it is, and the start that came
            there first is chosen (the discrepancy principle: to fit closer than the network knows
            its motions is to fit noise, at the cost of what was not observed). None to descend
            through all iterations and choose the smallest loss.
    """
    motions, starts, units = free.shape
    error = error_of(network)
    repeated = Batch(*(jnp.repeat(a, starts, axis=0) for a in batch))

    def losses(states: Array) -> Array:
        predicted = predictions(network, repeated, states, 0.0)
        context = states[:, network.io_size :]
        return error(predicted, repeated) + penalty * (context**2).sum(-1)

    def total(states: Array) -> tuple[Array, Array]:
        each = losses(states)
        return each.sum(), each

    def iteration(carry: _Descent, _: None) -> tuple[_Descent, None]:
        states, memory, best, best_loss, taken = carry
        (_, each), slope = jax.value_and_grad(total, has_aux=True)(states)
        better = each < best_loss
        if sufficient is not None:
            going = best_loss > sufficient
            better, taken = better & going, taken + going
        best = jnp.where(better[:, None], states, best)
        updates, memory = rule.update(slope, memory)
        states = jnp.clip(optax.apply_updates(states, updates), -bound, bound)
        return (states, memory, best, jnp.where(better, each, best_loss), taken), None

    sufficient = None if enough is None else enough.reshape(-1)
    flat = jnp.clip(free.reshape(-1, units), -bound, bound)
    worst, none = jnp.full(len(flat), jnp.inf, flat.dtype), jnp.zeros(len(flat), int)
    begin = (flat, rule.init(flat), flat, worst, none)
    if sufficient is None:
        (states, _, best, best_loss, taken), _ = jax.lax.scan(
            iteration, begin, None, length=iterations
        )
    else:
        # As soon as every motion has a start that arrived, nothing changes any more.
        states, _, best, best_loss, taken = jax.lax.while_loop(
            lambda carry: (
                (carry[-1].max() < iterations)
                & ~(carry[3] <= sufficient).reshape(motions, starts).any(1).all()
            ),
            lambda carry: iteration(carry, None)[0],
            begin,
        )
    last = losses(states)
    better = last < best_loss
    if sufficient is not None:
        better = better & (best_loss > sufficient)
    best = jnp.where(better[:, None], states, best).reshape(motions, starts, units)
    by_start = jnp.where(better, last, best_loss).reshape(motions, starts)
    chosen = by_start.argmin(1)
    if enough is not None:
        arrived = by_start <= enough
        first = jnp.where(arrived, taken.reshape(motions, starts), iterations + 2).argmin(1)
        chosen = jnp.where(arrived.any(1), first, chosen)
    kept = jnp.take_along_axis(best, chosen[:, None, None], axis=1)[:, 0]
    return initial_potentials(network, batch, kept), by_start, chosen
