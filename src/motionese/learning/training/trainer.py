"""One training: what stays the same all through it, and what follows from its state."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from hashlib import sha256
from math import isclose
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import optax
from jaxtyping import Array, Float, Int
from numpy import ndarray

from motionese.errors import SettingError
from motionese.learning.accuracy import errors_of, share_of_range
from motionese.learning.error import ERRORS, Error
from motionese.learning.fit import Fit
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.motions import Motions
from motionese.learning.objective import with_shared_channels
from motionese.learning.optimisers import training_rule
from motionese.learning.parameters import Parameters, learned_by
from motionese.learning.recognition.recognise import SAME_RATE
from motionese.learning.settings import Recognition, Training
from motionese.learning.status import Ending, Progress, Status
from motionese.learning.training.feed import ROWS, UPDATES, Feed
from motionese.learning.training.pieces import errors_by_share, recognised
from motionese.learning.training.shared_states import Groups, averaged, averaging
from motionese.learning.training.training_state import TrainingState
from motionese.learning.training.updates import Iterate, run_updates
from motionese.network import MTRNN, network_of

GLANCE = 200
"""Motions, of those learned in batches, by which progress is told at most."""
WARM = Recognition(iterations=8, starts=0)
"""Held-out motions are recognised from where the last recognition ended, so a few updates do."""


@dataclass(frozen=True)
class Trainer:
    """What stays the same all through a training; its state is what changes."""

    start: Parameters
    learned: tuple[str, ...]
    motions: Motions
    validation: Motions | None
    feed: Feed
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
        net, unset = self.start.network, {"batch"} if not self.settings.batch else set()
        kind = str((net.sizes, net.names, net.learned_bias, net.initial_io))
        learned = self.motions.contents if self.feed.whole is None else self.feed.whole
        unseen = self.validation.contents if self.validation else ()
        # Motions before networks: another number of motions is another start of both.
        parts = {
            "settings": (
                self.settings.model_dump_json(exclude=unset),
                jax.random.key_data(self.key),
            ),
            "motions": (*learned, *unseen),
            "networks": (kind, *jax.tree.leaves(self.start)),
            "shared initial states": (str(list(self.shared)), *self.shared.values()),
        }
        return {name: _digest(*values) for name, values in parts.items()}

    @property
    def chunk(self) -> int:
        """Epochs after which progress is told and convergence judged: of `UPDATES`, or one."""
        return max(UPDATES // self.feed.updates, 1)

    def epochs(self, state: TrainingState) -> int:
        """Return the whole epochs that are done."""
        return len(state.losses) // self.feed.updates

    def judges(self, state: TrainingState) -> bool:
        """Whether the state is one between two chunks of epochs."""
        done, within = divmod(len(state.losses), self.feed.updates)
        return not within and (done % self.chunk == 0 or done == self.settings.epochs)

    def problem(self, state: TrainingState) -> dict[str, Any]:
        """Return what `run_updates` takes beside the state itself."""
        named = ("start", "rule", "error", "bound", "noise", "shared", "key")
        first, length = self._next(len(state.losses))
        batch, order = self.feed.part(first, length)
        return {
            **{name: getattr(self, name) for name in named},
            "teacher_forcing": jnp.asarray(
                self.settings.teacher_forcing, self.start.network.weights.dtype
            ),
            **{"batch": batch, "order": order, "spread": self.feed.spread, "length": length},
        }

    def advanced(self, state: TrainingState) -> tuple[TrainingState, Status | None]:
        """Return the state some updates later, and how training ended if it did."""
        following, chunk = run_updates(state.latest, **self.problem(state))
        coming = self._next(len(state.losses) + len(chunk))
        if coming[1]:
            self.feed.part(*coming)  # read while the device is at work
        return self.judged(state, following, chunk)

    def judged(
        self, state: TrainingState, following: Iterate, chunk: Float[Array | ndarray, " U"]
    ) -> tuple[TrainingState, Status | None]:
        """Return the same, of what `run_updates` made of the state."""
        losses = np.concatenate([state.losses, np.asarray(chunk)])
        wrong = np.flatnonzero(~np.isfinite(losses))
        if len(wrong) or not following.finite:
            update = int(wrong[0]) if len(wrong) else int(following.updates)
            told = (
                "the loss or a weight was no longer finite at epoch "
                f"{update // self.feed.updates}; "
                f"what was learned in {self.epochs(state)} epochs is kept"
            )
            return replace(state, losses=losses), Status(Ending.DIVERGED, told)
        state = replace(state, latest=following, losses=losses)
        if not self.judges(state):
            return state, None
        if self.validation:
            state = self._validated(state)
        return state, self.ended(state)

    def _next(self, done: int) -> tuple[int, int]:
        """Return the first of the updates that follow in one call, and how many they are."""
        chunk, every = self.chunk * self.feed.updates, self.settings.epochs * self.feed.updates
        return done, min(self.feed.length, chunk - done % chunk, every - done)

    def _validated(self, state: TrainingState) -> TrainingState:
        """Return the state with the held-out motions recognised anew."""
        assert self.validation is not None, "asked of held-out motions"
        network, starts = self._now(state.latest).network, state.held_out[:, None]
        found = recognised(network, self.validation, starts, WARM)
        loss = sum(each.loss for each in found)
        better = loss < state.validation_losses.min(initial=np.inf)
        return replace(
            state,
            held_out=np.stack([each.initial_state for each in found]),
            validation_losses=np.append(state.validation_losses, loss),
            best=state.latest if better else state.best,
        )

    def ended(self, state: TrainingState) -> Status | None:
        """Return how training ended, or None while it goes on."""
        epochs, patience = self.epochs(state), self.settings.patience
        watched, last, whose = self.losses(state), patience, ""
        if self.validation:
            watched, last = state.validation_losses, -(-patience // self.chunk)
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

    def losses(self, state: TrainingState) -> Float[ndarray, " E"]:
        """Return the loss of every epoch, each motion's before the update that it is in."""
        whole = state.losses[: self.epochs(state) * self.feed.updates]
        return np.asarray(whole.reshape(-1, self.feed.updates).sum(1))

    def progress(self, state: TrainingState) -> Progress:
        """Return how good the network is by now; of many motions, by some of them."""
        now, channels = self._now(state.latest), self.motions.channels
        which, batch = self.glance
        errors = errors_of(now.network, batch, now.initial_states[which], 0.0)
        closed = share_of_range(errors[: len(self.motions)], channels)
        loss = error = None
        if self.validation:
            _, errors = errors_by_share(
                now.network, self.validation.batches(ROWS), state.held_out, (0.0,)
            )
            loss, error = float(state.validation_losses[-1]), share_of_range(errors, channels)
        epochs = self.losses(state)
        return Progress(len(epochs), float(epochs[-1]), closed, loss, error)

    @cached_property
    def glance(self) -> tuple[Int[ndarray, " G"], Batch]:
        """The motions, with empty ones, by which progress is told, and their numbers."""
        if self.feed.updates == 1 and self.feed.whole is not None:
            return np.arange(self.feed.count), self.feed.whole
        count = min(GLANCE, len(self.motions), max(ROWS // max(self.motions.lengths), 1))
        few = np.linspace(0, len(self.motions) - 1, count).astype(int)
        return few, self.motions.chosen(few.tolist()).batch()

    def fit(self, state: TrainingState, status: Status) -> Fit:
        """Return what training left: its latest network, or the best where one was looked for."""
        early = self.validation is not None and self.settings.patience > 0
        end = self._now(state.best if early else state.latest)
        given = self._pieces(), np.asarray(end.initial_states), (1.0, 0.0)
        states, forced, closed = errors_by_share(end.network, *given)
        fit = Fit(
            network=end.network,
            initial_states=states,
            names=self.motions.names,
            lengths=self.motions.lengths,
            rate_hz=self.motions.rate_hz,
            losses=self.losses(state),
            validation_losses=state.validation_losses,
            teacher_forced_error=forced,
            closed_loop_error=closed,
            validation_names=self.validation.names if self.validation else (),
            validation_error=np.zeros((0, len(self.motions.channels))),
            status=status,
        )
        if self.validation is None:
            return fit
        found = recognised(fit, self.validation)
        return replace(fit, validation_error=np.stack([f.residual for f in found]))

    def _now(self, iterate: Iterate) -> Parameters:
        """Return the parameters, on one device."""
        return self.start.moved(jax.tree.map(jnp.asarray, jax.device_get(iterate.free)))

    def _pieces(self) -> Iterable[tuple[range, Batch]]:
        """Yield all motions, so many at once as are few rows."""
        if self.feed.whole is not None and self.feed.whole.sensed[..., 0].size <= ROWS:
            return [(range(len(self.motions)), self.feed.whole)]
        return self.motions.batches(ROWS)


def make_trainer(
    network: MTRNN | Fit,
    motions: Motions,
    epochs: int | None,
    settings: Training,
    initial_states: Float[ndarray, "S N"] | None,
    groups: Groups,
    validation: Motions | None,
    key: Array | None,
    padded_to: tuple[int, int] | None = None,
    devices: Sequence[jax.Device] | None = None,
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
    feed = Feed(motions, settings.batch, key, padded_to, devices)
    error = ERRORS[settings.error]
    if error.variance and not network.variance:
        raise SettingError(
            f"the error '{settings.error}' needs a network that predicts variances, "
            "drawn with variance=True"
        )
    learned = learned_by(network, settings.learned)
    shared = averaging(network, groups, len(motions), feed.count)
    states = _states(network, len(motions), feed.count, initial_states)
    return Trainer(
        start=Parameters(network, averaged(network, states, shared)),
        learned=learned,
        motions=motions,
        validation=validation,
        feed=feed,
        rule=training_rule(settings, learned, feed.updates),
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
    return make_trainer(network, motions, 1, settings, None, {}, validation, key).origin


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
