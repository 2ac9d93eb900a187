"""The robot and the caregiver face to face: what one can see and do of the other's motions."""

from collections.abc import Mapping, Sequence
from copy import copy

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import open_body
from motionese.caregiver import (
    Caregiver,
    Demonstration,
    Manner,
    Motionese,
    RecordedCaregiver,
    ScriptedCaregiver,
)
from motionese.imitation.keys import generator_for
from motionese.imitation.performance import Performance, Watched, babble, mean_of, perform, watch
from motionese.imitation.settings import Settings
from motionese.learning import Motions
from motionese.network import MTRNN
from motionese.task import PrimitiveSequence

Recordings = Mapping[str, list[Demonstration]]
"""Recorded demonstrations by the sequence's name."""


class Scene:
    """A task, a body, a caregiver, and the postures from which sequences start.

    Attributes:
        settings: All settings.
        seed: What everything random depends on, beside its purpose.
        task: The task.
        body: The robot.
        joints: Which channels the commanded joints are.
        postures: Commanded joint angles [rad] that hold the hand in a place.
        manner: How sequences are shown where nothing else is said: as to an adult.
    """

    def __init__(self, settings: Settings, seed: int, recordings: Recordings | None = None) -> None:
        """Build the scene; `TaskError` if the robot cannot reach a place of the task.

        Args:
            settings: All settings.
            seed: What everything random depends on.
            recordings: Demonstrations that are shown in the place of scripted ones.
        """
        self.settings, self.seed = settings, seed
        self.manner = settings.caregiver.to_adults()
        self.task = settings.task.task()
        self.body = open_body(settings.body, self.task)
        self.joints = self.body.channels.indices(self.body.joints)
        self._recordings = recordings or {}
        self.postures = {
            place: self.body.command_reaching(self.task.position(place), name=f"place {place}")
            for place in self.task.places
        }
        self._arms = {place: self._arm_at(place) for place in self.task.places}

    def shown_with(self, motionese: Motionese) -> "Scene":
        """Return the scene in which sequences are shown with motionese, if nothing else is said."""
        other = copy(self)
        other.manner = self.manner.model_copy(update={"motionese": motionese})
        return other

    def caregiver(self, manner: Manner | None = None) -> Caregiver:
        """Return who shows sequences, in the scene's manner if no other is given."""
        scripted = ScriptedCaregiver(self.task, manner or self.manner, self.body)
        return RecordedCaregiver(self._recordings, scripted) if self._recordings else scripted

    def show(
        self, sequence: PrimitiveSequence, *occasion: str | int, manner: Manner | None = None
    ) -> Watched:
        """Let the caregiver show a sequence; on the same occasion it is the same to the bit.

        Where it is shown several times, what is returned is the mean of all of them.
        """
        manner = manner or self.manner
        caregiver, purpose = self.caregiver(manner), (*occasion, sequence.name)
        again = range(2, manner.motionese.times_shown + 1)
        shown = []
        for each in [purpose, *((*purpose, "again", time) for time in again)]:
            rng = generator_for(self.seed, "demonstration", *each)
            shown.append(watch(self.body, caregiver.demonstrate(sequence, rng), rng))
        return mean_of(shown)

    def as_own(self, start: str, watched: Watched) -> Float[ndarray, "T D"]:
        """Return what was watched with the own arm where it will start from, in every row."""
        values = watched.sensed.copy()
        values[:, self.joints] = self._arms[start]
        return values

    def seen(self, watched: Watched) -> Float[ndarray, "T D"]:
        """Return what was seen of what was watched: all but the joints, which are NaN."""
        values = watched.sensed.copy()
        values[:, self.joints] = np.nan
        return values

    def to_recognise(
        self,
        values: Sequence[Float[ndarray, "_ D"]],
        *,
        names: Sequence[str] | None = None,
    ) -> Motions:
        """Return what is recognised of demonstrations: all but the joints, these in the first row.

        What was not observed (NaN, as where the hand was out of view) is not recognised either.

        Args:
            values: The channels' values of every demonstration, see `as_own`.
            names: The demonstrations' names.
        """
        masks = [np.isfinite(value) for value in values]
        for mask in masks:
            mask[1:, self.joints] = False
        return Motions.from_arrays(
            values, self.body.channels, self.body.rate_hz, observed=masks, names=names
        )

    def perform(
        self,
        network: MTRNN,
        initial_state: Float[ndarray, " N"],
        sequence: PrimitiveSequence,
        steps: int,
        *occasion: str | int,
    ) -> Performance:
        """Let the robot perform a sequence from its start place."""
        rng = generator_for(self.seed, "performance", *occasion, sequence.name)
        posture = self.postures[sequence.start]
        acting = self.settings.imitation
        return perform(self.body, network, initial_state, posture, steps, acting, rng)

    def babble(self, index: int) -> Performance:
        """Let the robot make one babbled movement, as long as a primitive."""
        manner = self.settings.caregiver
        rng = generator_for(self.seed, "babbling", index)
        return babble(self.body, manner.primitive_rows, manner.stroke_steps, rng)

    def _arm_at(self, place: str) -> Float[ndarray, " J"]:
        """Return the joints' values [rad] while the hand rests in a place."""
        if self.settings.imitation.efference_copy:
            return self.postures[place]
        self.body.reset(self.postures[place], generator_for(self.seed, "posture", place))
        return np.asarray(self.body.sense()[self.joints])
