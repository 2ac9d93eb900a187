"""Updates of training in one compiled call: gradients of the error, updates (4) and (5)."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
from jax.sharding import Sharding
from jaxtyping import Array, Float, Int

from motionese.learning.error import Error
from motionese.learning.motions.batch import Batch
from motionese.learning.objective import predictions
from motionese.learning.parameters import Parameters
from motionese.learning.training.own_states import put_back, taken
from motionese.learning.training.shared_states import averaged, shared_among


class Iterate(eqx.Module):
    """What an update of training hands to the next.

    Free values of all that is learned, by the names of `PARAMETERS`; the update rule's memory; and
    updates done.
    """

    free: dict[str, Any]
    memory: optax.OptState
    updates: Array

    @property
    def finite(self) -> bool:
        """Whether every parameter is a number."""
        return all(np.isfinite(leaf).all() for leaf in jax.tree.leaves(self.free))


class Order(NamedTuple):
    """Which motions are in every update: where they stand in the batch, and which they are."""

    places: Int[Array, "U M"]
    motions: Int[Array, "U M"]


@eqx.filter_jit
def run_updates(
    state: Iterate,
    start: Parameters,
    batch: Batch,
    rule: optax.GradientTransformation,
    error: Error,
    teacher_forcing: Float[Array, ""],
    bound: Float[Array, " N"],
    noise: Float[Array, " N"] | None,
    shared: Mapping[str, Float[Array, "S S"]],
    key: Array,
    length: int,
    order: Order | None = None,
    spread: Sharding | None = None,
) -> tuple[Iterate, Float[Array, " U"]]:
    """Run some updates; return the state after them and the loss before each one.

    Without an order every update is of all motions in the batch. With one it takes its own: these
    motions' initial states and what the rule remembers of them are taken out, updated, put back.
    """

    def loss(
        free: dict[str, Any], start: Parameters, batch: Batch, disturbance: Array | None
    ) -> Array:
        now = start.moved(free)
        states, forced = now.initial_states, teacher_forcing
        return error(predictions(now.network, batch, states, forced, disturbance), batch).sum()

    def disturbance(update: Array, batch: Batch, motions: Array) -> Array | None:
        if noise is None:
            return None
        # One key a motion, so that its noise does not depend on what it is padded to.
        of_update, rows = jax.random.fold_in(key, update), batch.sensed.shape[1]
        keys = jax.vmap(lambda i: jax.random.fold_in(of_update, i))(motions)
        shape = (rows, start.network.size)
        return noise * jax.vmap(lambda k: jax.random.normal(k, shape, noise.dtype))(keys)

    def update(
        state: Iterate, start: Parameters, batch: Batch, motions: Array, groups: Mapping[str, Array]
    ) -> tuple[Iterate, Array]:
        if spread is not None:
            batch = jax.lax.with_sharding_constraint(batch, spread)  # type: ignore[no-untyped-call]
        given = start, batch, disturbance(state.updates, batch, motions)
        value, gradient = jax.value_and_grad(loss)(state.free, *given)
        if "initial_states" in gradient:
            states = averaged(start.network, gradient["initial_states"], groups)
            gradient = {**gradient, "initial_states": states}
        updates, memory = rule.update(gradient, state.memory, state.free)
        free = optax.apply_updates(state.free, updates)
        if "initial_states" in free:
            free["initial_states"] = jnp.clip(free["initial_states"], -bound, bound)
        return Iterate(free, memory, state.updates + 1), value

    def following(state: Iterate, chosen: Order | None) -> tuple[Iterate, Array]:
        if chosen is None:
            return update(state, start, batch, jnp.arange(len(batch.sensed)), shared)
        places, motions = chosen
        own = Parameters(start.network, start.initial_states[motions])
        some = Batch(*(part[places] for part in batch))
        groups = {level: shared_among(shares, motions) for level, shares in shared.items()}
        after, value = update(taken(state, motions), own, some, motions, groups)
        return put_back(state, after, motions, start.network, shared), value

    return jax.lax.scan(following, state, order, length=length)
