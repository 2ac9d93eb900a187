"""Recognition of what was shown.

It descends from what the network has learned (`Learner.experiences`), on arrays of fixed shapes, so
that nothing is compiled while a person waits.
"""

from dataclasses import dataclass
from functools import cached_property

import jax
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import Learner, Scene, Watched
from motionese.learning import Motions, generate, recognise_all, runtime_model
from motionese.learning.memory import RECALLED
from motionese.runtime import RuntimeModel
from motionese.task import PrimitiveSequence, Task
from motionese.teaching.drawing import most_rows
from motionese.teaching.online_recogniser import OnlineRecogniser
from motionese.teaching.view import hand_seen

RANDOM = 2
"""Random starts of a recognition, beside 0 and learned motions."""
ITERATIONS = 400
"""Of a recognition."""
FORETELLING = 8
"""The same of one from which the rest is foretold."""


@dataclass(frozen=True)
class Interpretation:
    """What the robot makes of what it has seen.

    Attributes:
        state: The initial state found. [N]
        path: The hand's path as recognised [m, world]. [T, 3]
        commands: The joint angles that the network would command meanwhile [rad]. [T, J]
        next: How the network would go on, for one stroke. [S, 3]
    """

    state: Float[ndarray, " N"]
    path: Float[ndarray, "T 3"]
    commands: Float[ndarray, "T J"]
    next: Float[ndarray, "S 3"]


def start_of(path: Float[ndarray, "T 3"], task: Task) -> PrimitiveSequence:
    """Return a primitive that leaves the place nearest to where a path begins."""
    return min(
        task.sequences(1), key=lambda s: float(np.linalg.norm(task.position(s.start) - path[0]))
    )


class Recogniser:
    """Recognises what a scene's robot watches."""

    def __init__(self, scene: Scene, learner: Learner) -> None:
        """Recognise with what a learner knows."""
        self.scene, self.learner = scene, learner
        self._most_rows = most_rows(scene.settings.caregiver)
        self._stroke = scene.settings.caregiver.primitive_rows

    def online(self) -> OnlineRecogniser | None:
        """Return what recognises a motion while it is shown; None where nothing was learned."""
        if not self.learner.experiences:
            return None
        motions = {e.name: e.motion for e in self.learner.experiences}
        return OnlineRecogniser(self.scene, self._model, motions)

    def at_the_end(self, watched: Watched) -> Interpretation:
        """Return what is understood of a whole demonstration."""
        effort = {"iterations": ITERATIONS, "starts": RANDOM}
        state, values = self._understood(watched, len(watched.sensed), effort)
        hand, shown = hand_seen(self.scene.body, values), len(watched.sensed)
        return Interpretation(
            state=state,
            path=hand[:shown],
            commands=values[:shown, self.scene.joints],
            next=hand[shown : shown + self._stroke],
        )

    def foretold(self, watched: Watched, rows: int) -> Float[ndarray, "T 3"]:
        """Return the path [m, world] that is expected of a demonstration after its first rows.

        Few steps from learned motions find it: it stays near what was learned.
        """
        effort = {"iterations": FORETELLING, "starts": 0}
        values = self._understood(watched, rows, effort)[1]
        return hand_seen(self.scene.body, values)[: len(watched.sensed)]

    def recalled(self, watched: Watched) -> Float[ndarray, " N"]:
        """Return the initial state of a whole demonstration, few steps from learned motions."""
        effort = {"iterations": FORETELLING, "starts": 0}
        return self._understood(watched, len(watched.sensed), effort)[0]

    def _understood(
        self, watched: Watched, rows: int, effort: dict[str, int]
    ) -> tuple[Float[ndarray, " N"], Float[ndarray, "R D"]]:
        """Return the state found from some rows, and what the network generates from it."""
        network, scene = self.learner.network, self.scene
        values = scene.as_own(start_of(watched.path, scene.task).start, watched)[:rows]
        seen = scene.to_recognise([values])
        starts = np.stack([np.zeros(network.size), *self._recalled(seen)])[None]
        settings = self.learner.for_levels(scene.settings.recognition).model_copy(update=effort)
        found = recognise_all(
            network,
            seen,
            starts=starts,
            settings=settings,
            key=jax.random.key(rows),
            padded_to=(1, self._most_rows),
        )[0]
        state, most = found.initial_state, self._most_rows + self._stroke
        return state, generate(network, state, most, first=values[0])

    @cached_property
    def _model(self) -> RuntimeModel:
        return runtime_model(self.learner.as_fit(self.scene.body.rate_hz))

    def _recalled(self, seen: Motions) -> Float[ndarray, "R N"]:
        """Return the initial states of learned motions nearest to what is seen, always as many."""
        states = np.zeros((RECALLED, self.learner.network.size))
        if self.learner.experiences:
            memory = self.learner.as_fit(self.scene.body.rate_hz).memory
            seen_rows = seen.batch(self._most_rows, 1)
            nearest = memory.nearest(self.learner.network, seen_rows).starts[0]
            states[: len(nearest)] = nearest
        return states
