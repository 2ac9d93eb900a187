"""One training: what stays the same all through it, and what follows from its course."""

from dataclasses import dataclass, replace
from hashlib import sha256

import jax
import jax.numpy as jnp
import numpy as np
import optax
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.errors import SettingError
from motionese.learning.accuracy import errors_of, share_of_range
from motionese.learning.batch import Batch
from motionese.learning.carried import carried
from motionese.learning.course import Course
from motionese.learning.epochs import State, begin, run_epochs
from motionese.learning.fit import Fit
from motionese.learning.held_out import look_again
from motionese.learning.motions import Motions
from motionese.learning.objective import initial_potentials
from motionese.learning.optimisers import training_rule
from motionese.learning.progress import Progress
from motionese.learning.recognise import recognise_all
from motionese.learning.settings import Training
from motionese.learning.status import Ending, Status
from motionese.network import MTRNN

CHUNK = 100
"""Epochs in one compiled call; progress is told and convergence judged between calls."""


@dataclass(frozen=True)
class Job:
    """What stays the same all through a training; its course is what changes."""

    network: MTRNN
    motions: Motions
    validation: Motions | None
    batch: Batch
    rule: optax.GradientTransformation
    bound: Float[Array, " N"]
    noise: Float[Array, " N"] | None
    key: Array
    settings: Training
    start: State

    @property
    def begun(self) -> Course:
        """The course before the first epoch."""
        held_out = np.zeros((len(self.validation or ()), self.network.size))
        return Course(self.start, self.start, held_out, np.zeros(0), np.zeros(0))

    @property
    def origin(self) -> dict[str, str]:
        """What a checkpoint must agree on, for its training to go on to the same bits."""
        net = self.network
        kind = str((net.sizes, net.names, net.learned_bias, net.initial_io))
        # Motions before networks: another number of motions is another start of both.
        parts = {
            "settings": (self.settings.model_dump_json(), jax.random.key_data(self.key)),
            "motions": (*self.batch, *(self.validation.batch() if self.validation else ())),
            "networks": (kind, *jax.tree.leaves((self.start, net.tau))),
        }
        return {name: _digest(*values) for name, values in parts.items()}

    def advanced(self, course: Course) -> tuple[Course, Status | None]:
        """Return the course a chunk of epochs later, and how training ended if it did."""
        following, chunk = run_epochs(
            course.state,
            self.network,
            self.batch,
            self.rule,
            jnp.asarray(self.settings.teacher_forcing, self.network.weights.dtype),
            self.bound,
            self.noise,
            self.key,
            min(CHUNK, self.settings.epochs - len(course.losses)),
        )
        losses = np.concatenate([course.losses, np.asarray(chunk)])
        diverged = _diverged(losses, course.state, following)
        if diverged:
            return replace(course, losses=losses), diverged
        course = replace(course, state=following, losses=losses)
        if self.validation:
            states, loss = look_again(
                following.trained(self.network), self.validation, course.held_out
            )
            better = loss < course.validation_losses.min(initial=np.inf)
            course = replace(
                course,
                held_out=states,
                validation_losses=np.append(course.validation_losses, loss),
                best=following if better else course.best,
            )
        return course, self.ended(course)

    def ended(self, course: Course) -> Status | None:
        """Return how training ended, or None while it goes on."""
        converged = _converged(course, self.settings, bool(self.validation))
        if converged is None and len(course.losses) == self.settings.epochs:
            return Status(Ending.STOPPED, f"all {self.settings.epochs} epochs done")
        return converged

    def progress(self, course: Course) -> Progress:
        """Return how good the network is by now."""
        network, channels = course.state.trained(self.network), self.motions.channels
        closed = share_of_range(self._errors(network, course.state, 0.0), channels)
        held_out = None
        if self.validation:
            errors = errors_of(network, self.validation.batch(), course.held_out, 0.0)
            held_out = share_of_range(errors, channels)
        return Progress(
            epoch=len(course.losses),
            loss=float(course.losses[-1]),
            closed_loop_error=closed,
            validation_loss=float(course.validation_losses[-1]) if self.validation else None,
            validation_error=held_out,
        )

    def fit(self, course: Course, status: Status) -> Fit:
        """Return what the course left: its last state, or the best one where one was looked for."""
        early = self.validation is not None and self.settings.patience > 0
        state = course.best if early else course.state
        network = state.trained(self.network)
        free = state.parameters["initial"]
        fit = Fit(
            network=network,
            initial_states=np.asarray(initial_potentials(network, self.batch, free))[
                : len(self.motions)
            ],
            names=self.motions.names,
            lengths=self.motions.lengths,
            rate_hz=self.motions.rate_hz,
            losses=course.losses,
            validation_losses=course.validation_losses,
            teacher_forced_error=self._errors(network, state, 1.0),
            closed_loop_error=self._errors(network, state, 0.0),
            validation_names=self.validation.names if self.validation else (),
            validation_error=np.zeros((0, len(self.motions.channels))),
            status=status,
        )
        if self.validation is None:
            return fit
        found = recognise_all(fit, self.validation)
        return replace(fit, validation_error=np.stack([f.residual for f in found]))

    def _errors(self, network: MTRNN, state: State, forced: float) -> Float[ndarray, "S D"]:
        errors = errors_of(network, self.batch, state.parameters["initial"], forced)
        return errors[: len(self.motions)]


def prepared(
    network: MTRNN,
    motions: Motions,
    epochs: int | None,
    settings: Training,
    initial_states: Float[ndarray, "S N"] | None,
    validation: Motions | None,
    key: Array | None,
    padded_to: tuple[int, int] | None,
) -> Job:
    """Check what is to be trained, with the arguments of `train`."""
    settings = settings if epochs is None else settings.model_copy(update={"epochs": epochs})
    if settings.epochs < 1:
        raise SettingError(f"epochs must be ≥ 1, got {settings.epochs}")
    network, motions = carried(network, motions)
    if validation is not None:
        if validation.rate_hz != motions.rate_hz:
            raise SettingError(
                f"the held-out motions have {validation.rate_hz:g} rows a second, "
                f"the others {motions.rate_hz:g}"
            )
        _, validation = carried(network, validation)
    noise = network.per_unit(settings.noise, 0.0) if any(settings.noise.values()) else None
    if key is None and noise is not None:
        raise SettingError("training with state noise needs a key, got none")
    if initial_states is not None and initial_states.shape != (len(motions), network.size):
        raise SettingError(
            f"initial states must have shape {(len(motions), network.size)}, "
            f"got {initial_states.shape}"
        )
    count, rows = padded_to or (len(motions), max(motions.lengths))
    rule = training_rule(settings, settings.epochs, network.learned_bias)
    return Job(
        network=network,
        motions=motions,
        validation=validation,
        batch=motions.batch(rows, count),
        rule=rule,
        bound=network.per_unit(settings.bound, jnp.inf),
        noise=noise,
        key=jax.random.key(0) if key is None else key,
        settings=settings,
        start=begin(network, count, initial_states, rule),
    )


def _digest(*values: object) -> str:
    whole = sha256()
    for value in values:
        whole.update(value.encode() if isinstance(value, str) else np.asarray(value).tobytes())
    return whole.hexdigest()


def _diverged(losses: Float[ndarray, " E"], before: State, after: State) -> Status | None:
    """Return that a loss or a parameter is no longer finite, and where, or None if all are."""
    wrong = np.flatnonzero(~np.isfinite(losses))
    if after.finite and not len(wrong):
        return None
    epoch = int(wrong[0]) if len(wrong) else int(after.epoch)
    return Status(
        Ending.DIVERGED,
        f"the loss or a weight was no longer finite at epoch {epoch}; "
        f"what was learned in {int(before.epoch)} epochs is kept",
    )


def _converged(course: Course, settings: Training, held_out: bool) -> Status | None:
    """Return that the loss no longer falls, or None while it does or nobody asks."""
    watched, patience = course.losses, settings.patience
    if held_out:
        watched, patience = course.validation_losses, -(-settings.patience // CHUNK)
    if patience and len(watched) > patience:
        before, since = watched[:-patience].min(), watched[-patience:].min()
        if since > before * (1 - settings.tolerance):
            whose = " of the held-out motions" if held_out else ""
            return Status(
                Ending.CONVERGED,
                f"the loss{whose} fell by less than {settings.tolerance:g} of itself "
                f"in {settings.patience} epochs, at epoch {len(course.losses)}",
            )
    return None
