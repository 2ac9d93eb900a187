"""Equation (5) in recognition: the weights frozen, initial states descend from several starts."""

import equinox as eqx
import jax
import jax.numpy as jnp
import optax
from jaxtyping import Array

from motionese.learning.error import error_of
from motionese.learning.objective import predictions
from motionese.learning.recognition.search import Found, Search

_Descent = tuple[Array, optax.OptState, Array, Array, Array]
"""What is sought, the update rule's memory, the best so far, its loss, and updates taken."""


@eqx.filter_jit
def descend(search: Search, rule: optax.GradientTransformation, iterations: int) -> Found:
    """Descend by an update rule from every start, so many updates at most.

    Only the gradient of the initial states is asked for, so that of the weights is never computed.
    """
    network, batch, error = search.network, search.repeated, error_of(search.network)

    def losses(sought: Array) -> Array:
        predicted = predictions(network, batch, search.states(sought))
        return error(predicted, batch) + search.prior(sought)

    def total(sought: Array) -> tuple[Array, Array]:
        each = losses(sought)
        return each.sum(), each

    def iteration(carry: _Descent) -> _Descent:
        sought, memory, best, best_loss, taken = carry
        (_, each), slope = jax.value_and_grad(total, has_aux=True)(sought)
        going = search.short(best_loss)
        better = (each < best_loss) & going
        best = jnp.where(better[:, None], sought, best)
        updates, memory = rule.update(slope, memory)
        sought = jnp.clip(
            optax.apply_updates(sought, updates * search.paces), -search.limit, search.limit
        )
        return sought, memory, best, jnp.where(better, each, best_loss), taken + going

    begin = search.begin
    worst, none = jnp.full(len(begin), jnp.inf, begin.dtype), jnp.zeros(len(begin), int)
    # As soon as every motion has a start that arrived, nothing changes any more.
    last, _, best, best_loss, taken = jax.lax.while_loop(
        lambda carry: (
            (carry[-1].max() < iterations) & search.unfinished(carry[3], search.short(carry[3]))
        ),
        iteration,
        (begin, rule.init(begin), begin, worst, none),
    )
    loss = losses(last)
    better = (loss < best_loss) & search.short(best_loss)
    best = jnp.where(better[:, None], last, best)
    return search.found(best, jnp.where(better, loss, best_loss), taken)
