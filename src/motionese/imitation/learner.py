"""What a robot has become: its network and the experiences it learns from; how it is kept."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.channels import Channels
from motionese.errors import StorageError
from motionese.imitation.attention import Weigh
from motionese.imitation.keys import key_for
from motionese.imitation.repertoire import (
    Element,
    Sharing,
    element_called,
    element_seen,
    first_primitive,
)
from motionese.imitation.scene import Scene
from motionese.imitation.settings import NetworkSettings, StagedTraining
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
from motionese.learning.memory import Memory
from motionese.network import MTRNN, grow

S = TypeVar("S", Training, Recognition)
BABBLING = "babbling"
Nearest = Callable[[Sequence[Element], Float[ndarray, "T D"], Float[ndarray, " D"]], str]
"""The element nearest to what was seen, see `element_seen`."""


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
        begins_with: By level below the top one: the element of its repertoire that it begins with.
            Itself where that is not told: it was made while the level was the top one.
        begins: The rows at which its primitives began as it was shown; one where that is not told.
    """

    loop: int
    motion: str
    values: Float[ndarray, "T D"]
    initial_state: Float[ndarray, " N"]
    error: Float[ndarray, " D"]
    begins_with: Mapping[str, str] = field(default_factory=dict)
    begins: tuple[int, ...] = (0,)

    @property
    def name(self) -> str:
        """Its name among all that was learned, such as 'UR ↓ (loop 3)'."""
        return f"{self.motion} (loop {self.loop})"


@dataclass(frozen=True)
class Learner:
    """A network and its experiences, the oldest first.

    Attributes:
        elements: The repertoires of its levels, as far as motions share them.
    """

    network: MTRNN
    experiences: tuple[Experience, ...] = ()
    elements: tuple[Element, ...] = ()

    def experiencing(
        self,
        loop: int,
        motion: str,
        values: Float[ndarray, "T D"],
        state: Float[ndarray, " N"],
        begins_with: Mapping[str, str] | None = None,
        begins: tuple[int, ...] = (0,),
    ) -> "Learner":
        """Return the learner with a further experience."""
        unknown = np.full(values.shape[1], np.nan)
        fresh = Experience(loop, motion, values, state, unknown, begins_with or {}, begins)
        return replace(self, experiences=(*self.experiences, fresh))

    def begins_with(
        self,
        motion: str,
        shown: Float[ndarray, "T D"] | None = None,
        nearest: Nearest = element_seen,
    ) -> dict[str, str]:
        """Return by closed level the element of its repertoire that a motion begins with.

        A level is closed once another has opened above it.

        Args:
            motion: What the caregiver calls it.
            shown: What was seen of it, to go by that instead; NaN where nothing was. [T, D]
            nearest: Which element's own motion is nearest to what was seen.
        """
        scale = self.channels.interval_widths
        return {
            level: element_called(known, motion) if shown is None else nearest(known, shown, scale)
            for level in self.network.names[1:-1]
            if (known := self.repertoire_of(level))
        }

    def renamed(self, names: Iterable[tuple[str, str]]) -> "Learner":
        """Return the learner with motions called otherwise: names before and after, in order."""
        known = [e.motion for e in self.experiences] + [e.motion for e in self.elements]
        called = dict(zip(known, known, strict=True))
        for before, name in names:
            called = {first: name if now == before else now for first, now in called.items()}
        experiences = tuple(
            replace(
                e,
                motion=called[e.motion],
                begins_with={level: called.get(m, m) for level, m in e.begins_with.items()},
            )
            for e in self.experiences
        )
        elements = tuple(replace(e, motion=called[e.motion]) for e in self.elements)
        return replace(self, experiences=experiences, elements=elements)

    def repertoire_of(self, level: str) -> tuple[Element, ...]:
        """Return the elements of a level's repertoire."""
        return tuple(e for e in self.elements if e.level == level)

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
        settings: StagedTraining,
        rate_hz: float,
        *,
        key: Array | None = None,
        padded_to: tuple[int, int] = (0, 0),
        weigh: Weigh | None = None,
        progress: Callable[[Progress], None] | None = None,
    ) -> tuple["Learner", Fit]:
        """Return what the learner becomes by training on all its experiences, and the fit.

        Args:
            settings: Rates, bounds, noise; those of levels that are not open are left out.
            rate_hz: Rows a second.
            key: JAX random key of the state noise.
            padded_to: Motions and rows that training is compiled for, where there are fewer.
            weigh: How much each row of an experience weighs; alike where left out.
            progress: Called while it trains.
        """
        motions = self.motions(rate_hz, weigh)
        fit = train(
            self.network,
            motions,
            settings=self.for_levels(settings),
            initial_states=np.array([e.initial_state for e in self.experiences]),
            shared=self.groups(settings.shared),
            key=key,
            padded_to=(max(padded_to[0], len(motions)), max(padded_to[1], *motions.lengths)),
            progress=progress,
        )
        learned = zip(self.experiences, fit.initial_states, fit.closed_loop_error, strict=True)
        experiences = tuple(replace(e, initial_state=s, error=error) for e, s, error in learned)
        after = replace(self, network=fit.network, experiences=experiences)
        return after._known(settings.shared), fit

    def groups(self, shared: Mapping[str, Sharing]) -> dict[str, list[str]]:
        """Return by level whose initial states every experience shares, see `Sharing`."""
        closed = self.network.names[1:-1]
        groups = {}
        for level, sharing in shared.items():
            if sharing == "first primitive" and level in self.network.names:
                groups[level] = [first_primitive(e.motion) for e in self.experiences]
            elif sharing == "repertoire" and level in closed:
                one = not self.repertoire_of(level)
                groups[level] = [
                    "" if one else e.begins_with.get(level, e.motion) for e in self.experiences
                ]
        return groups

    def _known(self, shared: Mapping[str, Sharing]) -> "Learner":
        """Return the learner with the repertoires of its levels as they are after training."""
        known = {(e.level, e.motion): e for e in self.elements}
        top = self.network.names[-1]
        if shared.get(top) == "repertoire":
            for e in self.experiences:
                if e.motion != BABBLING:
                    known[top, e.motion] = Element(top, e.motion, e.values, e.initial_state)
        for level, members in self.groups(shared).items():
            units = self.network.units(level)
            for member, e in zip(members, self.experiences, strict=True):
                if (level, member) in known:
                    of = known[level, member]
                    state = of.initial_state.copy()
                    state[units] = e.initial_state[units]
                    known[level, member] = replace(of, initial_state=state)
        return replace(self, elements=tuple(known.values()))

    def motions(self, rate_hz: float, weigh: Weigh | None = None) -> Motions:
        """Return the experiences as motions to train on; NaN is what was not observed.

        Args:
            rate_hz: Rows a second.
            weigh: How much each row of an experience weighs; alike where left out.
        """
        width = len(self.channels)
        return Motions.from_arrays(
            [e.values for e in self.experiences],
            self.channels,
            rate_hz,
            observed=[np.isfinite(e.values) for e in self.experiences],
            names=[e.name for e in self.experiences],
            weights=weigh
            and [np.repeat(weigh(e.values)[:, None], width, axis=1) for e in self.experiences],
        )

    @property
    def channels(self) -> Channels:
        """The channels of the body that it has."""
        assert self.network.channels is not None, "a learner's network is drawn for a body"
        return self.network.channels

    def repertoire(self) -> Float[ndarray, "R N"]:
        """Return initial states of all that it has learned, in every combination of its levels.

        Each context level takes its states from its repertoire, or from the latest experience of
        every motion: the Cf_0 of one beside the Cs_0 of another. Nothing learned is a state of 0.
        """
        latest = {e.motion: e.initial_state for e in self.experiences}
        levels, begin = [], 0  # those of IO go with the first context level's
        ends = np.cumsum(self.network.sizes)[1:]
        for level, end in zip(self.network.names[1:], ends, strict=True):
            closed = level != self.network.names[-1]
            known = [e.initial_state for e in self.repertoire_of(level)] if closed else []
            units = self.network.units(level)
            different = {s[units].tobytes(): s[begin:end] for s in known or latest.values()}
            levels.append(list(different.values()))
            begin = end
        return np.array(
            [np.concatenate(each) for each in product(*levels)] or [np.zeros(self.network.size)]
        )

    @property
    def memory(self) -> Memory:
        """The repertoire as what recognition recalls its starts from."""
        states = self.repertoire()
        unknown = np.full((len(states), len(self.channels)), np.nan)
        return Memory(tuple(map(str, range(len(states)))), states, unknown)

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
        return replace(self, network=network, experiences=experiences)

    def for_levels(self, settings: S) -> S:
        """Return settings without what they say of levels that are not open yet.

        Nor is the top level slower: there is none above it that could take over.
        """
        names = self.network.names
        limited = {
            field: {level: value for level, value in by_level.items() if level in known}
            for field, known in (("bound", names), ("noise", names), ("slower", names[:-1]))
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
    told = {
        "experiences": [
            {"loop": e.loop, "motion": e.motion, "begins_with": e.begins_with, "begins": e.begins}
            for e in learner.experiences
        ],
        "elements": [{"level": e.level, "motion": e.motion} for e in learner.elements],
    }
    arrays = {f"values.{i}": e.values for i, e in enumerate(learner.experiences)}
    for i, element in enumerate(learner.elements):
        arrays |= {
            f"element.{i}.values": element.values,
            f"element.{i}.state": element.initial_state,
        }
    write_fit(path, learner.as_fit(rate_hz), arrays, {**facts, **told})


def read_learner(path: Path) -> tuple[Learner, dict[str, Any]]:
    """Read what `write_learner` wrote; `StorageError` if it is cut short, or not one of ours."""
    fit, arrays, facts = read_fit(path)
    learned = zip(fit.initial_states, fit.closed_loop_error, strict=True)
    try:
        experiences = tuple(
            Experience(
                values=arrays[f"values.{i}"],
                initial_state=state,
                error=error,
                **{**each, "begins": tuple(each.get("begins", (0,)))},
            )
            for i, (each, (state, error)) in enumerate(
                zip(facts.pop("experiences"), learned, strict=True)
            )
        )
        elements = tuple(
            Element(
                values=arrays[f"element.{i}.values"],
                initial_state=arrays[f"element.{i}.state"],
                **each,
            )
            for i, each in enumerate(facts.pop("elements"))
        )
    except (KeyError, TypeError, ValueError) as error:
        raise StorageError(f"{path}: a model, but not a robot of an experiment") from error
    return Learner(fit.network, experiences, elements), facts
