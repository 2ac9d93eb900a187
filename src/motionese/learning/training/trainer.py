"""One training: what stays the same all through it, and what follows from its state."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from hashlib import sha256
from math import isclose
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import optax
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.errors import SettingError
from motionese.learning.accuracy import errors_of, share_of_range
from motionese.learning.error import ERRORS, Error
from motionese.learning.fit import Fit
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.motions import Motions
from motionese.learning.objective import initial_potentials, with_shared_channels
from motionese.learning.optimisers import training_rule
from motionese.learning.parameters import Parameters, learned_by
from motionese.learning.recognition.recognise import SAME_RATE, recognise_all
from motionese.learning.settings import Recognition, Training
from motionese.learning.status import Ending, Progress, Status
from motionese.learning.training.epochs import Iterate, run_epochs
from motionese.learning.training.shared_states import Groups, averaged, averaging
from motionese.learning.training.training_state import TrainingState
from motionese.network import MTRNN, network_of

CHUNK = 100
"""Epochs in one compiled call; progress is told and convergence judged between calls."""
WARM = Recognition(iterations=8, starts=0)
"""Held-out motions are recognised from where the last recognition ended, so a few updates do."""


@dataclass(frozen=True)
class Trainer:
    """What stays the same all through a training; its state is what changes."""

    start: Parameters
    learned: tuple[str, ...]
    motions: Motions
    validation: Motions | None
    batch: Batch
    rule: optax.GradientTransformation
    error: Error
    bound: Float[Array, " N"]
    noise: Float[Array, " N"] | None
    shared: Mapping[str, Float[Array, "C C"]]
    key: Array
    settings: Training

    @property
    def beginning(self) -> TrainingState:
        """The state before the first epoch."""
        free = self.start.free(self.learned)
        first = Iterate(free, self.rule.init(free), jnp.asarray(0))
        held_out = np.zeros((len(self.validation or ()), self.start.network.size))
        return TrainingState(first, first, held_out, np.zeros(0), np.zeros(0))

    @property
    def origin(self) -> dict[str, str]:
        """What a checkpoint must agree on, for its training to go on to the same bits."""
        net = self.start.network
        kind = str((net.sizes, net.names, net.learned_bias, net.initial_io))
        # Motions before networks: another number of motions is another start of both.
        parts = {
            "settings": (self.settings.model_dump_json(), jax.random.key_data(self.key)),
            "motions": (*self.batch, *(self.validation.batch() if self.validation else ())),
            "networks": (kind, *jax.tree.leaves(self.start)),
            "shared initial states": (str(list(self.shared)), *self.shared.values()),
        }
        return {name: _digest(*values) for name, values in parts.items()}

    @property
    def problem(self) -> dict[str, Any]:
        """What `run_epochs` takes beside the state and the number of epochs."""
        named = ("start", "batch", "rule", "error", "bound", "noise", "shared", "key")
        forced = jnp.asarray(self.settings.teacher_forcing, self.start.network.weights.dtype)
        return {"teacher_forcing": forced} | {name: getattr(self, name) for name in named}

    def chunk(self, state: TrainingState) -> int:
        """Return how many epochs are run before the training is judged again."""
        return min(CHUNK, self.settings.epochs - len(state.losses))

    def advanced(self, state: TrainingState) -> tuple[TrainingState, Status | None]:
        """Return the state a chunk of epochs later, and how training ended if it did."""
        return self.judged(
            state, *run_epochs(state.latest, **self.problem, length=self.chunk(state))
        )

    def judged(
        self, state: TrainingState, following: Iterate, chunk: Float[Array | ndarray, " E"]
    ) -> tuple[TrainingState, Status | None]:
        """Return the same, of what `run_epochs` made of the chunk."""
        losses = np.concatenate([state.losses, np.asarray(chunk)])
        wrong = np.flatnonzero(~np.isfinite(losses))
        if len(wrong) or not following.finite:
            epoch = int(wrong[0]) if len(wrong) else int(following.epoch)
            told = (
                f"the loss or a weight was no longer finite at epoch {epoch}; "
                f"what was learned in {int(state.latest.epoch)} epochs is kept"
            )
            return replace(state, losses=losses), Status(Ending.DIVERGED, told)
        state = replace(state, latest=following, losses=losses)
        if self.validation:
            network, starts = self.start.moved(following.free).network, state.held_out[:, None]
            found = recognise_all(network, self.validation, starts=starts, settings=WARM)
            loss = sum(each.loss for each in found)
            better = loss < state.validation_losses.min(initial=np.inf)
            state = replace(
                state,
                held_out=np.stack([each.initial_state for each in found]),
                validation_losses=np.append(state.validation_losses, loss),
                best=following if better else state.best,
            )
        return state, self.ended(state)

    def ended(self, state: TrainingState) -> Status | None:
        """Return how training ended, or None while it goes on."""
        epochs, patience = len(state.losses), self.settings.patience
        watched, last, whose = state.losses, patience, ""
        if self.validation:
            watched, last = state.validation_losses, -(-patience // CHUNK)
            whose = " of the held-out motions"
        if last and len(watched) > last:
            before, since = watched[:-last].min(), watched[-last:].min()
            tolerance = self.settings.tolerance
            if since > before - tolerance * abs(before):
                return Status(
                    Ending.CONVERGED,
                    f"the loss{whose} fell by less than {tolerance:g} of itself "
                    f"in {patience} epochs, at epoch {epochs}",
                )
        if epochs == self.settings.epochs:
            return Status(Ending.STOPPED, f"all {epochs} epochs done")
        return None

    def progress(self, state: TrainingState) -> Progress:
        """Return how good the network is by now."""
        now, channels = self.start.moved(state.latest.free), self.motions.channels
        closed = share_of_range(self._errors(now, 0.0), channels)
        loss = error = None
        if self.validation:
            errors = errors_of(now.network, self.validation.batch(), state.held_out, 0.0)
            loss, error = float(state.validation_losses[-1]), share_of_range(errors, channels)
        return Progress(len(state.losses), float(state.losses[-1]), closed, loss, error)

    def fit(self, state: TrainingState, status: Status) -> Fit:
        """Return what training left: its latest network, or the best where one was looked for."""
        early = self.validation is not None and self.settings.patience > 0
        end = self.start.moved((state.best if early else state.latest).free)
        states = initial_potentials(end.network, self.batch, end.initial_states)
        fit = Fit(
            network=end.network,
            initial_states=np.asarray(states)[: len(self.motions)],
            names=self.motions.names,
            lengths=self.motions.lengths,
            rate_hz=self.motions.rate_hz,
            losses=state.losses,
            validation_losses=state.validation_losses,
            teacher_forced_error=self._errors(end, 1.0),
            closed_loop_error=self._errors(end, 0.0),
            validation_names=self.validation.names if self.validation else (),
            validation_error=np.zeros((0, len(self.motions.channels))),
            status=status,
        )
        if self.validation is None:
            return fit
        found = recognise_all(fit, self.validation)
        return replace(fit, validation_error=np.stack([f.residual for f in found]))

    def _errors(self, now: Parameters, forced: float) -> Float[ndarray, "S D"]:
        errors = errors_of(now.network, self.batch, now.initial_states, forced)
        return errors[: len(self.motions)]


def make_trainer(
    network: MTRNN | Fit,
    motions: Motions,
    epochs: int | None,
    settings: Training,
    initial_states: Float[ndarray, "S N"] | None,
    groups: Groups,
    validation: Motions | None,
    key: Array | None,
    padded_to: tuple[int, int] | None,
) -> Trainer:
    """Check what is to be trained, with the arguments of `train`."""
    settings = settings if epochs is None else settings.model_copy(update={"epochs": int(epochs)})
    if settings.epochs < 1:
        raise SettingError(f"epochs must be ≥ 1, got {settings.epochs}")
    if isinstance(network, Fit):
        if not isclose(motions.rate_hz, network.rate_hz, rel_tol=SAME_RATE):
            raise SettingError(
                f"the motions have {motions.rate_hz:g} rows a second, "
                f"the model was trained at {network.rate_hz:g}"
            )
        if initial_states is None:
            initial_states = network.states_of(motions.names)
    network = network_of(network)
    network, motions = with_shared_channels(network, motions)
    if validation is not None:
        if validation.rate_hz != motions.rate_hz:
            raise SettingError(
                f"the held-out motions have {validation.rate_hz:g} rows a second, "
                f"the others {motions.rate_hz:g}"
            )
        _, validation = with_shared_channels(network, validation)
    noise = network.per_unit(settings.noise, 0.0) if any(settings.noise.values()) else None
    if key is None and noise is not None:
        raise SettingError("training with state noise needs a key, got none")
    count, rows = padded_to or (len(motions), max(motions.lengths))
    error = ERRORS[settings.error]
    if error.variance and not network.variance:
        raise SettingError(
            f"the error '{settings.error}' needs a network that predicts variances, "
            "drawn with variance=True"
        )
    learned = learned_by(network, settings.learned)
    shared = averaging(network, groups, len(motions), count)
    states = _states(network, len(motions), count, initial_states)
    return Trainer(
        start=Parameters(network, averaged(network, states, shared)),
        learned=learned,
        motions=motions,
        validation=validation,
        batch=motions.batch(rows, count),
        rule=training_rule(settings, learned),
        error=error,
        bound=network.per_unit(settings.bound, jnp.inf),
        noise=noise,
        shared=shared,
        key=jax.random.key(0) if key is None else key,
        settings=settings,
    )


def origin_of(
    network: MTRNN | Fit,
    motions: Motions,
    settings: Training,
    validation: Motions | None,
    key: Array,
) -> dict[str, str]:
    """Return what a training must agree on to go on, whatever the number of its epochs."""
    return make_trainer(network, motions, 1, settings, None, {}, validation, key, None).origin


def _states(
    network: MTRNN, motions: int, count: int, given: Float[ndarray, "S N"] | None
) -> Float[Array, "C N"]:
    """Return the initial states to start from, for `count` motions with those that pad."""
    states = np.zeros((count, network.size))
    if given is not None:
        given = np.asarray(given)
        if given.shape != (motions, network.size):
            raise SettingError(
                f"initial states must have shape {(motions, network.size)}, got {given.shape}"
            )
        states[:motions] = given
    return jnp.asarray(states, network.weights.dtype)


def _digest(*values: object) -> str:
    whole = sha256()
    for value in values:
        whole.update(value.encode() if isinstance(value, str) else np.asarray(value).tobytes())
    return whole.hexdigest()
