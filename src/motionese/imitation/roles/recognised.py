"""Demonstrations of a lesson as the robot recognised them, from which all roles are measured."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.keys import key_for
from motionese.imitation.learner import Learner
from motionese.imitation.scene import Scene
from motionese.imitation.strokes import directions
from motionese.learning import Recognition, generate, recognise_all
from motionese.network import MTRNN
from motionese.task import Primitive, PrimitiveSequence

Bearing = Callable[[Float[ndarray, "*shape D"]], Float[ndarray, "*shape 2"]]
"""Where the hand is seen [rad] when the channels have some values, see `SimulatedRobot`."""


@dataclass(frozen=True)
class RecognisedDemonstration:
    """One demonstration, as it was seen and as it was recognised.

    Attributes:
        sequence: What was shown.
        number: Which of its demonstrations it is, from 1.
        initial_state: u_0 of all levels; NaN where recognition came to nothing. [N]
        first: The first row, in the channels' units. [D]
        begins: The rows at which its strokes begin.
        seen: Azimuth and elevation [rad] at which the shown hand was seen. [T, 2]
    """

    sequence: PrimitiveSequence
    number: int
    initial_state: Float[ndarray, " N"]
    first: Float[ndarray, " D"]
    begins: tuple[int, ...]
    seen: Float[ndarray, "T 2"]

    @property
    def directions(self) -> Float[ndarray, " S"]:
        """The direction [rad] of every stroke, as it was seen."""
        return self.directions_in(self.seen)

    def directions_in(self, seen: Float[ndarray, "_ 2"]) -> Float[ndarray, " S"]:
        """Return the directions [rad] in which another seen hand goes in the rows of its strokes.

        Args:
            seen: Bearings of that hand [rad], of as many rows or more.
        """
        return directions(seen, self.begins, len(self.seen))


@dataclass(frozen=True)
class RecognisedLesson:
    """Recognised demonstrations of all motions of a lesson, and what is needed to judge others.

    Attributes:
        network: The network that recognised them; it carries channels.
        bearing: Where the hand is seen.
        demonstrations: Of every motion the same number, motion by motion.
        primitives: All primitives of the task, each with the direction [rad] in which it is seen
            to go.
    """

    network: MTRNN
    bearing: Bearing
    demonstrations: tuple[RecognisedDemonstration, ...]
    primitives: Mapping[Primitive, float]

    @property
    def usable(self) -> tuple[RecognisedDemonstration, ...]:
        """Those whose initial state is finite."""
        return tuple(d for d in self.demonstrations if np.isfinite(d.initial_state).all())

    @property
    def left_out(self) -> int:
        """How many demonstrations no measure counts, since their initial state is not finite."""
        return len(self.demonstrations) - len(self.usable)

    @property
    def sequences(self) -> tuple[PrimitiveSequence, ...]:
        """The motions of the lesson."""
        return tuple(dict.fromkeys(d.sequence for d in self.demonstrations))

    def ambiguous(self, sequence: PrimitiveSequence, stroke: int) -> bool:
        """Whether another motion goes on otherwise than a sequence in its stroke (from 0).

        The other has the same strokes before, and starts from the same place.
        """
        own = sequence.primitives
        return any(
            other.start == sequence.start
            and other.primitives[:stroke] == own[:stroke]
            and other.primitives[stroke : stroke + 1] not in ((), own[stroke : stroke + 1])
            for other in self.sequences
        )

    def generated(
        self,
        network: MTRNN,
        initial_states: Float[ndarray, "K N"],
        demonstrations: Sequence[RecognisedDemonstration],
    ) -> list[Float[ndarray, " S"]]:
        """Return the directions [rad] of every stroke that a network generates in closed loop.

        Args:
            network: The network, whole or cut.
            initial_states: Of every motion to be generated.
            demonstrations: Of each, where it begins and which rows are its strokes'.
        """
        rows = max(len(d.seen) for d in self.demonstrations)
        firsts = np.array([d.first for d in demonstrations])
        seen = self.bearing(generate(network, initial_states, rows, first=firsts))
        return [d.directions_in(path) for d, path in zip(demonstrations, seen, strict=True)]


def recognised(
    scene: Scene,
    learner: Learner,
    lesson: Sequence[PrimitiveSequence],
    settings: Recognition,
    demonstrations: int,
    occasion: str = "roles",
) -> RecognisedLesson:
    """Show fresh demonstrations of a lesson's motions and let a learner recognise them.

    Recognition starts from the repertoire; nothing is performed, and nothing learned.

    Args:
        scene: Robot and caregiver.
        learner: What the robot has become.
        lesson: The motions.
        settings: How their initial states are found.
        demonstrations: How many of each motion.
        occasion: On what they are shown; on the same one they are the same.
    """
    shown = [
        (sequence, number, scene.show(sequence, occasion, number))
        for sequence, number in product(lesson, range(1, demonstrations + 1))
    ]
    values = [scene.as_own(sequence.start, watched) for sequence, _, watched in shown]
    found = recognise_all(
        (learner.network, learner.memory),
        scene.to_recognise(values),
        settings=learner.for_levels(settings),
        key=key_for(scene.seed, "recognition", occasion),
    )
    bearing = scene.body.bearing
    alone = {s.primitives[0]: scene.show(s, occasion, 0) for s in scene.task.sequences(1)}
    return RecognisedLesson(
        learner.network,
        bearing,
        tuple(
            RecognisedDemonstration(
                sequence,
                number,
                each.initial_state,
                own[0],
                watched.begins,
                bearing(watched.sensed),
            )
            for (sequence, number, watched), own, each in zip(shown, values, found, strict=True)
        ),
        {
            primitive: float(directions(bearing(w.sensed), w.begins, len(w.sensed))[0])
            for primitive, w in alone.items()
        },
    )
