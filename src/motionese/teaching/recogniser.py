"""Recognition of what is being drawn: while the pen moves, and when it is lifted.

Both descend from what the network has learned (`Learner.experiences`) and from what was understood
a moment ago, on arrays of fixed shapes, so that nothing is compiled while a person waits. While the
pen moves a window of the last `WINDOW` strokes is looked at; the state at its begin is carried on
as the window slides.
"""

from dataclasses import dataclass

import jax
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import Learner, Scene, Watched
from motionese.learning import Motions, activity, generate, recognise_all
from motionese.learning.memory import RECALLED
from motionese.task import PrimitiveSequence, Task
from motionese.teaching.drawing import most_rows
from motionese.teaching.view import hand_seen
from motionese.unit_interval import logit

WINDOW = 3
"""Strokes that are looked at while the pen moves."""
RANDOM = 2
"""Random starts of a recognition, beside learned motions and what was understood a moment ago."""
ONLINE, AT_THE_END = 40, 400
"""Iterations of recognition while the pen moves, and when it is lifted."""
FEWEST_ROWS = 3
SMALLEST = 1e-6


@dataclass(frozen=True)
class Interpretation:
    """What the robot makes of what it has seen.

    Attributes:
        begin: The row of the demonstration that recognition begins at.
        state: The initial state found for that row. [N]
        first: The channels' values in that row, the network's first input. [D]
        path: The hand's path as recognised [m, world], from row 0 of the demonstration. [T, 3]
        next: How the network would go on, for one stroke. [S, 3]
    """

    begin: int
    state: Float[ndarray, " N"]
    first: Float[ndarray, " D"]
    path: Float[ndarray, "T 3"]
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

    def so_far(self, watched: Watched, before: Interpretation | None) -> Interpretation | None:
        """Return what is understood while the pen moves; None where it is too early to tell."""
        if len(watched.path) < FEWEST_ROWS:
            return None
        begin = max(0, len(watched.path) - WINDOW * self._stroke)
        return self._interpreted(watched, begin, WINDOW * self._stroke, ONLINE, before)

    def at_the_end(self, watched: Watched, before: Interpretation | None = None) -> Interpretation:
        """Return what is understood of a whole demonstration."""
        whole = before if before is not None and before.begin == 0 else None
        return self._interpreted(watched, 0, self._most_rows, AT_THE_END, whole)

    def _interpreted(
        self,
        watched: Watched,
        begin: int,
        padded: int,
        iterations: int,
        before: Interpretation | None,
    ) -> Interpretation:
        network, scene = self.learner.network, self.scene
        values = scene.as_own(start_of(watched.path, scene.task).start, watched)[begin:]
        seen = scene.to_recognise([values], own_arm=begin == 0)
        starts = np.stack([self._carried(before, begin), *self._recalled(seen, padded)])[None]
        effort = {"iterations": iterations, "starts": RANDOM}
        settings = self.learner.for_levels(scene.settings.recognition).model_copy(update=effort)
        key, size = jax.random.key(len(watched.path)), (1, padded)
        found = recognise_all(
            network, seen, starts=starts, settings=settings, key=key, padded_to=size
        )[0]
        first = values[0].copy()
        if begin:  # in the middle of a motion the arm is where it is recognised to be
            first[scene.joints] = found.path[0, scene.joints]
        rows = padded + self._stroke
        hand = hand_seen(scene.body, generate(network, found.initial_state, rows, first=first))
        earlier = before.path[:begin] if before is not None else watched.path[:0]
        return Interpretation(
            begin=begin,
            state=found.initial_state,
            first=first,
            path=np.concatenate([earlier, watched.path[len(earlier) : begin], hand[: len(values)]]),
            next=hand[len(values) : len(values) + self._stroke],
        )

    def _carried(self, before: Interpretation | None, begin: int) -> Float[ndarray, " N"]:
        """Return what was understood a moment ago, at the row where recognition begins."""
        network = self.learner.network
        if before is None or before.begin > begin or len(before.state) != network.size:
            return np.zeros(network.size)
        if before.begin == begin:
            return before.state
        y = activity(network, before.state, self._most_rows, first=before.first)
        return logit(np.clip(y[begin - before.begin], SMALLEST, 1 - SMALLEST))

    def _recalled(self, seen: Motions, padded: int) -> Float[ndarray, "R N"]:
        """Return the initial states of learned motions nearest to what is seen, always as many."""
        states = np.zeros((RECALLED, self.learner.network.size))
        if self.learner.experiences:
            memory = self.learner.as_fit(self.scene.body.rate_hz).memory
            nearest = memory.nearest(self.learner.network, seen.batch(padded, 1)).starts[0]
            states[: len(nearest)] = nearest
        return states
