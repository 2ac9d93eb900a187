"""Training: equations (4) and (5), the weights by α and every motion's initial states by β."""

from collections.abc import Callable
from dataclasses import dataclass

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.errors import SettingError
from motionese.learning.carried import carried
from motionese.learning.generate import channel_errors, predicted
from motionese.learning.motions import Batch, Motions
from motionese.learning.objective import initial_potentials, predictions, squared_errors
from motionese.learning.optimisers import training_rule
from motionese.learning.recognise import recognise_all
from motionese.learning.settings import Recognition, Training
from motionese.learning.status import Ending, Status
from motionese.network import MTRNN

CHUNK = 100
"""Epochs in one compiled call; progress is told and convergence judged between calls."""

VALIDATING = Recognition(iterations=50, starts=0, rate=0.1)
"""How held-out motions are recognised after every chunk: warm, so a few updates do."""


@dataclass(frozen=True)
class Fit:
    """What training leaves.

    Attributes:
        network: The trained network; it carries the motions' channels.
        initial_states: u_0 of every motion, all levels; IO as the first row was sensed. [S, N]
        names: The motions' names.
        losses: Equation (3) per epoch, summed over motions, before that epoch's update. [E]
        validation_losses: The same of the held-out motions, recognised after every `CHUNK`
            epochs; empty without any. [E / CHUNK]
        teacher_forced_error: Root mean squared error of every motion with what was sensed as
            the input of every step, each channel in its unit. [S, D]
        closed_loop_error: Root mean squared error of every motion in closed loop, each channel in
            its unit. [S, D]
        status: How training ended.
    """

    network: MTRNN
    initial_states: Float[ndarray, "S N"]
    names: tuple[str, ...]
    losses: Float[ndarray, " E"]
    validation_losses: Float[ndarray, " V"]
    teacher_forced_error: Float[ndarray, "S D"]
    closed_loop_error: Float[ndarray, "S D"]
    status: Status


class _State(eqx.Module):
    """What an epoch hands to the next."""

    parameters: dict[str, Array]
    memory: optax.OptState
    epoch: Array


def train(
    network: MTRNN,
    motions: Motions,
    *,
    epochs: int | None = None,
    settings: Training | None = None,
    initial_states: Float[ndarray, "S N"] | None = None,
    validation: Motions | None = None,
    key: Array | None = None,
    padded_to: tuple[int, int] | None = None,
    progress: Callable[[int, float], None] | None = None,
) -> Fit:
    """Train a network on motions, equations (3)–(5).

    Held-out motions are recognised after every chunk of epochs, the weights frozen: their loss
    tells how well motions that were not learned fit the network.

    Args:
        network: Where to start from.
        motions: What to learn.
        epochs: Overrides `settings.epochs`.
        settings: Rates, optimiser, bounds, noise.
        initial_states: Initial states of every motion to start from; 0 where left out.
        validation: Motions held out.
        key: JAX random key of the state noise; needed where there is any.
        padded_to: Motions and rows to pad the batch to, so that different batches share compiled
            code.
        progress: Called between chunks with the epochs done and the last loss.

    Raises:
        SettingError: Channels or initial states do not fit the network, an unknown level in
            bounds or noise, noise without a key, or no epochs.
    """
    settings = settings or Training()
    epochs = settings.epochs if epochs is None else epochs
    if epochs < 1:
        raise SettingError(f"epochs must be ≥ 1, got {epochs}")
    network, motions = carried(network, motions)
    noise = network.per_unit(settings.noise, 0.0) if any(settings.noise.values()) else None
    if key is None and noise is not None:
        raise SettingError("training with state noise needs a key, got none")
    count, rows = padded_to or (len(motions), max(motions.lengths))
    batch = motions.batch(rows, count)
    rule = training_rule(settings, network.learned_bias)
    if initial_states is not None and initial_states.shape != (len(motions), network.size):
        raise SettingError(
            f"initial states must have shape {(len(motions), network.size)}, "
            f"got {initial_states.shape}"
        )
    state = _begin(network, batch, initial_states, rule)
    held_out = _HeldOut(validation) if validation else None
    losses: list[float] = []
    status = Status(Ending.STOPPED, f"all {epochs} epochs done")
    while len(losses) < epochs:
        following, chunk = _epochs(
            state,
            network,
            batch,
            rule,
            jnp.asarray(settings.teacher_forcing, network.weights.dtype),
            network.per_unit(settings.bound, jnp.inf),
            noise,
            jax.random.key(0) if key is None else key,
            min(CHUNK, epochs - len(losses)),
        )
        losses.extend(np.asarray(chunk).tolist())
        diverged = _diverged(losses, state, following)
        if diverged:
            status = diverged
            break
        state = following
        if held_out:
            held_out.recognise(_trained(network, state))
        if progress:
            progress(len(losses), losses[-1])
        ended = _converged(losses, settings, held_out)
        if ended:
            status = ended
            break
    return _fit(_trained(network, state), state, motions, batch, losses, held_out, status)


class _HeldOut:
    """Held-out motions, recognised again and again from where the last recognition ended."""

    def __init__(self, motions: Motions) -> None:
        self.motions = motions
        self.states: Float[ndarray, "V 1 N"] | None = None
        self.losses: list[float] = []

    def recognise(self, network: MTRNN) -> None:
        found = recognise_all(network, self.motions, starts=self.states, settings=VALIDATING)
        self.states = np.stack([f.initial_state for f in found])[:, None]
        self.losses.append(sum(f.loss for f in found))


def _begin(
    network: MTRNN,
    batch: Batch,
    initial_states: Float[ndarray, "S N"] | None,
    rule: optax.GradientTransformation,
) -> _State:
    free = jnp.zeros((len(batch.sensed), network.size), network.weights.dtype)
    if initial_states is not None:
        free = free.at[: len(initial_states)].set(jnp.asarray(initial_states, free.dtype))
    parameters = {"weights": network.weights, "bias": network.bias, "initial": free}
    return _State(parameters, rule.init(parameters), jnp.asarray(0))


def _trained(network: MTRNN, state: _State) -> MTRNN:
    return network.with_parameters(state.parameters["weights"], state.parameters["bias"])


@eqx.filter_jit
def _epochs(
    state: _State,
    network: MTRNN,
    batch: Batch,
    rule: optax.GradientTransformation,
    teacher_forcing: Float[Array, ""],
    bound: Float[Array, " N"],
    noise: Float[Array, " N"] | None,
    key: Array,
    length: int,
) -> tuple[_State, Float[Array, " E"]]:
    """Run some epochs in one compiled call."""

    def loss(parameters: dict[str, Array], disturbance: Array | None) -> Array:
        current = network.with_parameters(parameters["weights"], parameters["bias"])
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

    def epoch(state: _State, _: None) -> tuple[_State, Array]:
        value, gradient = jax.value_and_grad(loss)(state.parameters, disturbance(state.epoch))
        updates, memory = rule.update(gradient, state.memory, state.parameters)
        parameters = optax.apply_updates(state.parameters, updates)
        parameters["initial"] = jnp.clip(parameters["initial"], -bound, bound)
        return _State(parameters, memory, state.epoch + 1), value

    return jax.lax.scan(epoch, state, None, length=length)


def _diverged(losses: list[float], before: _State, after: _State) -> Status | None:
    """Return that a loss or a parameter is no longer finite, and where, or None if all are."""
    wrong = np.flatnonzero(~np.isfinite(losses))
    sound = all(bool(jnp.isfinite(leaf).all()) for leaf in after.parameters.values())
    if sound and not len(wrong):
        return None
    epoch = int(wrong[0]) if len(wrong) else int(after.epoch)
    return Status(
        Ending.DIVERGED,
        f"the loss or a weight was no longer finite at epoch {epoch}; "
        f"what was learned in {int(before.epoch)} epochs is kept",
    )


def _converged(losses: list[float], settings: Training, held_out: _HeldOut | None) -> Status | None:
    """Return that the loss no longer falls, or None while it does or nobody asks."""
    watched, patience = losses, settings.patience
    if held_out:
        watched, patience = held_out.losses, -(-settings.patience // CHUNK)
    if patience and len(watched) > patience:
        before, since = min(watched[:-patience]), min(watched[-patience:])
        if since > before * (1 - settings.tolerance):
            return Status(
                Ending.CONVERGED,
                f"the loss fell by less than {settings.tolerance:g} of itself "
                f"in {settings.patience} epochs, at epoch {len(losses)}",
            )
    return None


def _fit(
    network: MTRNN,
    state: _State,
    motions: Motions,
    batch: Batch,
    losses: list[float],
    held_out: _HeldOut | None,
    status: Status,
) -> Fit:
    free = state.parameters["initial"]
    initial = np.asarray(initial_potentials(network, batch, free))
    forced, closed = (
        channel_errors(predicted(network, batch, free, share), batch, motions.channels)
        for share in (1.0, 0.0)
    )
    return Fit(
        network=network,
        initial_states=initial[: len(motions)],
        names=motions.names,
        losses=np.asarray(losses),
        validation_losses=np.asarray(held_out.losses if held_out else []),
        teacher_forced_error=forced[: len(motions)],
        closed_loop_error=closed[: len(motions)],
        status=status,
    )
