"""Epochs of training in one compiled call: gradients of the error, updates (4) and (5)."""

from collections.abc import Mapping
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
from jaxtyping import Array, Float

from motionese.learning.error import Error
from motionese.learning.motions.batch import Batch
from motionese.learning.objective import predictions
from motionese.learning.parameters import Parameters
from motionese.learning.training.shared_states import averaged


class Iterate(eqx.Module):
    """What an epoch of training hands to the next.

    Free values of all that is learned, by the names of `PARAMETERS`; the update rule's memory; and
    epochs done.
    """

    free: dict[str, Any]
    memory: optax.OptState
    epoch: Array

    @property
    def finite(self) -> bool:
        """Whether every parameter is a number."""
        return all(np.isfinite(leaf).all() for leaf in jax.tree.leaves(self.free))


@eqx.filter_jit
def run_epochs(
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
) -> tuple[Iterate, Float[Array, " E"]]:
    """Run some epochs; return the state after them and the loss before each one's update."""

    def loss(free: dict[str, Any], disturbance: Array | None) -> Array:
        now = start.moved(free)
        states, forced = now.initial_states, teacher_forcing
        return error(predictions(now.network, batch, states, forced, disturbance), batch).sum()

    def disturbance(epoch: Array) -> Array | None:
        if noise is None:
            return None
        # One key a motion, so that its noise does not depend on what it is padded to.
        of_epoch, (count, rows) = jax.random.fold_in(key, epoch), batch.sensed.shape[:2]
        keys = jax.vmap(lambda i: jax.random.fold_in(of_epoch, i))(jnp.arange(count))
        shape = (rows, start.network.size)
        return noise * jax.vmap(lambda k: jax.random.normal(k, shape, noise.dtype))(keys)

    def epoch(state: Iterate, _: None) -> tuple[Iterate, Array]:
        value, gradient = jax.value_and_grad(loss)(state.free, disturbance(state.epoch))
        if "initial_states" in gradient:
            states = averaged(start.network, gradient["initial_states"], shared)
            gradient = {**gradient, "initial_states": states}
        updates, memory = rule.update(gradient, state.memory, state.free)
        free = optax.apply_updates(state.free, updates)
        if "initial_states" in free:
            free["initial_states"] = jnp.clip(free["initial_states"], -bound, bound)
        return Iterate(free, memory, state.epoch + 1), value

    return jax.lax.scan(epoch, state, None, length=length)
