"""What a robot has become: its network and the experiences it learns from; how it is kept."""

from collections.abc import Callable, Collection
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.channels import Channels
from motionese.errors import StorageError
from motionese.imitation.keys import key_for
from motionese.imitation.scene import Scene
from motionese.imitation.settings import NetworkSettings
from motionese.learning import (
    Ending,
    Fit,
    Motions,
    Progress,
    Recognition,
    Status,
    Training,
    read_fit,
    train,
    write_fit,
)
from motionese.learning.error import ERRORS
from motionese.network import MTRNN, grow
from motionese.task import PrimitiveSequence, common_beginning

S = TypeVar("S", Training, Recognition)
BABBLING = "babbling"


@dataclass(frozen=True)
class Experience:
    """One motion of the own body, and the initial state that belongs to it.

    Attributes:
        loop: The loop it was made in; 0 for babbling.
        motion: The sequence's name.
        values: What was sensed, and commanded, in the channels' units; NaN where it was neither.
            [T, D]
        initial_state: u_0 of all levels. [N]
        error: Root mean squared error in closed loop after training, each channel in its unit;
            NaN before. [D]
    """

    loop: int
    motion: str
    values: Float[ndarray, "T D"]
    initial_state: Float[ndarray, " N"]
    error: Float[ndarray, " D"]

    @property
    def name(self) -> str:
        """Its name among all that was learned, such as 'UR ↓ (loop 3)'."""
        return f"{self.motion} (loop {self.loop})"


@dataclass(frozen=True)
class Learner:
    """A network and its experiences, the oldest first."""

    network: MTRNN
    experiences: tuple[Experience, ...] = ()

    def experiencing(
        self, loop: int, motion: str, values: Float[ndarray, "T D"], state: Float[ndarray, " N"]
    ) -> "Learner":
        """Return the learner with a further experience."""
        unknown = np.full(values.shape[1], np.nan)
        fresh = Experience(loop, motion, values, state, unknown)
        return replace(self, experiences=(*self.experiences, fresh))

    def remembering(self, loop: int, memory: int, rehearsed: Collection[str]) -> "Learner":
        """Return the learner with the experiences of its last loops.

        Args:
            loop: The present loop.
            memory: How many loops are remembered, the present one included.
            rehearsed: Motions whose latest experience is kept in any case.
        """
        latest = {e.motion: e for e in self.experiences if e.motion in rehearsed}
        kept = [
            e
            for e in self.experiences
            if e.loop > max(loop - memory, 0) or latest.get(e.motion) is e
        ]
        return replace(self, experiences=tuple(kept))

    def trained(
        self,
        settings: Training,
        rate_hz: float,
        *,
        key: Array | None = None,
        padded_to: tuple[int, int] = (0, 0),
        progress: Callable[[Progress], None] | None = None,
    ) -> tuple["Learner", Fit]:
        """Return what the learner becomes by training on all its experiences, and the fit.

        Args:
            settings: Rates, bounds, noise; those of levels that are not open are left out.
            rate_hz: Rows a second.
            key: JAX random key of the state noise.
            padded_to: Motions and rows that training is compiled for, where there are fewer.
            progress: Called while it trains.
        """
        motions = self.motions(rate_hz)
        fit = train(
            self.network,
            motions,
            settings=self.for_levels(settings),
            initial_states=np.array([e.initial_state for e in self.experiences]),
            key=key,
            padded_to=(max(padded_to[0], len(motions)), max(padded_to[1], *motions.lengths)),
            progress=progress,
        )
        learned = zip(self.experiences, fit.initial_states, fit.closed_loop_error, strict=True)
        experiences = tuple(replace(e, initial_state=s, error=error) for e, s, error in learned)
        return Learner(fit.network, experiences), fit

    def motions(self, rate_hz: float) -> Motions:
        """Return the experiences as motions to train on; NaN is what was not observed."""
        return Motions.from_arrays(
            [e.values for e in self.experiences],
            self.channels,
            rate_hz,
            observed=[np.isfinite(e.values) for e in self.experiences],
            names=[e.name for e in self.experiences],
        )

    @property
    def channels(self) -> Channels:
        """The channels of the body that it has."""
        assert self.network.channels is not None, "a learner's network is drawn for a body"
        return self.network.channels

    def start_for(self, sequence: PrimitiveSequence) -> Float[ndarray, " N"]:
        """Return where recognition of a sequence begins: the latest state of the most similar one.

        The most similar known motion has the longest common beginning; without any, the state
        after babbling, or 0.
        """
        best = np.zeros(self.network.size)
        longest = -1
        for experience in self.experiences:
            common = common_beginning(experience.motion, sequence.name)
            if common >= longest:
                longest, best = common, experience.initial_state
        return best

    def repertoire(self) -> Float[ndarray, "R N"]:
        """Return initial states of all that it has learned, in every combination of its levels.

        Each context level takes its states from the latest experience of one of the motions: the
        Cf_0 of one beside the Cs_0 of another. Nothing learned is a state of 0.
        """
        latest = {e.motion: e.initial_state for e in self.experiences}
        ends = np.cumsum(self.network.sizes)[1:-1]
        levels = zip(*(np.split(state, ends) for state in latest.values()), strict=True)
        states = [np.concatenate(each) for each in product(*levels) if each]
        return np.array(states or [np.zeros(self.network.size)])

    def grown(self, settings: NetworkSettings, key: Array) -> "Learner":
        """Return the learner with the next level opened, its initial states at 0."""
        level = settings.drawn_levels(self.channels)[len(self.network.levels)]
        network = grow(
            self.network,
            level,
            key=key,
            influence=settings.influence,
            gain=settings.gain,
            scale=settings.scale,
        )
        opened = np.zeros(level.size)
        experiences = tuple(
            replace(e, initial_state=np.concatenate([e.initial_state, opened]))
            for e in self.experiences
        )
        return Learner(network, experiences)

    def for_levels(self, settings: S) -> S:
        """Return settings without bounds and noise of levels that are not open yet."""
        names = {level.name for level in self.network.levels}
        limited = {
            field: {level: value for level, value in by_level.items() if level in names}
            for field in ("bound", "noise")
            if isinstance(by_level := getattr(settings, field, None), dict)
        }
        return settings.model_copy(update=limited)

    def as_fit(self, rate_hz: float) -> Fit:
        """Return what is learned as a fit, whose motions are the experiences."""
        units, width = self.network.size, len(self.channels)
        errors = np.array([e.error for e in self.experiences]).reshape(-1, width)
        return Fit(
            network=self.network,
            initial_states=np.array([e.initial_state for e in self.experiences]).reshape(-1, units),
            names=tuple(e.name for e in self.experiences),
            lengths=tuple(len(e.values) for e in self.experiences),
            rate_hz=rate_hz,
            losses=np.zeros(0),
            validation_losses=np.zeros(0),
            teacher_forced_error=np.full_like(errors, np.nan),
            closed_loop_error=errors,
            validation_names=(),
            validation_error=np.zeros((0, width)),
            status=Status(Ending.STOPPED, "learned in imitation loops"),
        )


def newborn(scene: Scene, levels: int) -> Learner:
    """Draw the network of a scene's seed, with so many levels; it has done nothing yet.

    It predicts variances where it is to be trained by an error that needs them.
    """
    settings, channels = scene.settings.network, scene.body.channels
    network = MTRNN.draw(
        settings.drawn_levels(channels)[:levels],
        key=key_for(scene.seed, "network"),
        gain=settings.gain,
        scale=settings.scale,
        learned_bias=settings.learned_bias,
        initial_io=settings.initial_io,
        channels=channels,
        variance=ERRORS[scene.settings.training.error].variance,
    )
    return Learner(network)


def babbled(scene: Scene, learner: Learner) -> Learner:
    """Let a learner make babbled movements and learn from them, without state noise."""
    settings = scene.settings
    start = np.zeros(learner.network.size)
    for index in range(settings.babbling.movements):
        values = scene.babble(index).experience(settings.imitation.efference_copy)
        learner = learner.experiencing(0, BABBLING, values, start)
    if not learner.experiences:
        return learner
    quiet = settings.training.model_copy(update={"noise": {}, "epochs": settings.babbling.epochs})
    return learner.trained(quiet, scene.body.rate_hz)[0]


def write_learner(path: Path, learner: Learner, rate_hz: float, facts: dict[str, Any]) -> None:
    """Write a learner as a fit, with its experiences and JSON-able facts, whole or not at all."""
    experiences = [{"loop": e.loop, "motion": e.motion} for e in learner.experiences]
    arrays = {f"values.{i}": e.values for i, e in enumerate(learner.experiences)}
    write_fit(path, learner.as_fit(rate_hz), arrays, {**facts, "experiences": experiences})


def read_learner(path: Path) -> tuple[Learner, dict[str, Any]]:
    """Read what `write_learner` wrote; `StorageError` if it is cut short, or not one of ours."""
    fit, arrays, facts = read_fit(path)
    learned = zip(fit.initial_states, fit.closed_loop_error, strict=True)
    try:
        experiences = tuple(
            Experience(each["loop"], each["motion"], arrays[f"values.{i}"], state, error)
            for i, (each, (state, error)) in enumerate(
                zip(facts.pop("experiences"), learned, strict=True)
            )
        )
    except (KeyError, TypeError, ValueError) as error:
        raise StorageError(f"{path}: a model, but not a robot of an experiment") from error
    return Learner(fit.network, experiences), facts
