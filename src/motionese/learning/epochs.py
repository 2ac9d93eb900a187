"""Epochs of training in one compiled call: gradients of equation (3), updates (4) and (5)."""

from dataclasses import replace

import equinox as eqx
import jax
import jax.numpy as jnp
import optax
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.learning.batch import Batch
from motionese.learning.objective import predictions, squared_errors
from motionese.network import MTRNN


class State(eqx.Module):
    """What an epoch hands to the next: parameters, the update rule's memory, epochs done."""

    parameters: dict[str, Array]
    memory: optax.OptState
    epoch: Array

    def trained(self, network: MTRNN) -> MTRNN:
        """Return the network with these weights and bias."""
        return replace(network, weights=self.parameters["weights"], bias=self.parameters["bias"])

    @property
    def finite(self) -> bool:
        """Whether every parameter is a number."""
        return all(bool(jnp.isfinite(leaf).all()) for leaf in self.parameters.values())


def begin(
    network: MTRNN,
    motions: int,
    initial_states: Float[ndarray, "S N"] | None,
    rule: optax.GradientTransformation,
) -> State:
    """Return the state before the first epoch; initial states are 0 where none are given."""
    free = jnp.zeros((motions, network.size), network.weights.dtype)
    if initial_states is not None:
        free = free.at[: len(initial_states)].set(jnp.asarray(initial_states, free.dtype))
    parameters = {"weights": network.weights, "bias": network.bias, "initial": free}
    return State(parameters, rule.init(parameters), jnp.asarray(0))


@eqx.filter_jit
def run_epochs(
    state: State,
    network: MTRNN,
    batch: Batch,
    rule: optax.GradientTransformation,
    teacher_forcing: Float[Array, ""],
    bound: Float[Array, " N"],
    noise: Float[Array, " N"] | None,
    key: Array,
    length: int,
) -> tuple[State, Float[Array, " E"]]:
    """Run some epochs; return the state after them and the loss before each one's update."""

    def loss(parameters: dict[str, Array], disturbance: Array | None) -> Array:
        current = replace(network, weights=parameters["weights"], bias=parameters["bias"])
        predicted = predictions(current, batch, parameters["initial"], teacher_forcing, disturbance)
        return squared_errors(predicted, batch).sum()

    def disturbance(epoch: Array) -> Array | None:
        if noise is None:
            return None
        # One key a motion, so that its noise does not depend on what it is padded to.
        of_epoch, (count, rows) = jax.random.fold_in(key, epoch), batch.sensed.shape[:2]
        keys = jax.vmap(lambda i: jax.random.fold_in(of_epoch, i))(jnp.arange(count))
        shape = (rows, network.size)
        return noise * jax.vmap(lambda k: jax.random.normal(k, shape, noise.dtype))(keys)

    def epoch(state: State, _: None) -> tuple[State, Array]:
        value, gradient = jax.value_and_grad(loss)(state.parameters, disturbance(state.epoch))
        updates, memory = rule.update(gradient, state.memory, state.parameters)
        parameters = optax.apply_updates(state.parameters, updates)
        parameters["initial"] = jnp.clip(parameters["initial"], -bound, bound)
        return State(parameters, memory, state.epoch + 1), value

    return jax.lax.scan(epoch, state, None, length=length)
