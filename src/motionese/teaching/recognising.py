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

from motionese.caregiver import PUSHING_BUTTONS, Motion
from motionese.experiment import Learner, Scene
from motionese.experiment.imitation_loop import for_levels, shown_as
from motionese.experiment.perform import ARM, Watched
from motionese.learning import activity, generate, placed, recognise_all
from motionese.teaching.drawing import most_rows
from motionese.teaching.reading import corners_of, hand_seen, nearest_corner

WINDOW = 3
"""Strokes that are looked at while the pen moves."""
RECALLED, RANDOM = 5, 2
"""Starts of a recognition: learned motions that are nearest to what is seen, and random ones."""
ONLINE, AT_THE_END = 40, 400
"""Iterations of recognition while the pen moves, and when it is lifted."""
MEMORY = 48
"""So many learned motions are looked through, the latest."""
FEWEST_ROWS = 3
SMALLEST = 1e-6


@dataclass(frozen=True)
class Understood:
    """What the robot makes of what it has seen.

    Attributes:
        begin: The row of the demonstration that recognition begins at.
        state: The initial state found for that row. [N]
        first: The channels' values in that row, the network's first input. [6]
        path: The hand's path as recognised [m, world], from row 0 of the demonstration. [T, 3]
        next: How the network would go on, for one stroke. [S, 3]
    """

    begin: int
    state: Float[ndarray, " N"]
    first: Float[ndarray, "6"]
    path: Float[ndarray, "T 3"]
    next: Float[ndarray, "S 3"]


class Recogniser:
    """Recognises what a scene's robot watches."""

    def __init__(self, scene: Scene, learner: Learner) -> None:
        """Recognise with what a learner knows."""
        self.scene, self.learner = scene, learner
        self._manner = scene.settings.caregiver
        self._stroke = self._manner.stroke_steps + self._manner.rest_steps
        self._corners = corners_of(self._manner)

    def so_far(self, watched: Watched, before: Understood | None) -> Understood | None:
        """Return what is understood while the pen moves; None where it is too early to tell."""
        if len(watched.path) < FEWEST_ROWS:
            return None
        begin = max(0, len(watched.path) - WINDOW * self._stroke)
        return self._understood(watched, begin, WINDOW * self._stroke, ONLINE, before)

    def at_the_end(self, watched: Watched, before: Understood | None) -> Understood:
        """Return what is understood of a whole demonstration."""
        whole = before if before is not None and before.begin == 0 else None
        return self._understood(watched, 0, most_rows(self._manner), AT_THE_END, whole)

    def starts_at(self, watched: Watched) -> Motion:
        """Return a motion that starts where a demonstration does."""
        corner = nearest_corner(watched.path[0], self._corners)
        return next(m for m in PUSHING_BUTTONS.sequences(1) if m.start == corner)

    def _understood(
        self, watched: Watched, begin: int, padded: int, iterations: int, before: Understood | None
    ) -> Understood:
        network, settings = self.learner.network, self.scene.settings
        values = self.scene.as_own(self.starts_at(watched), watched)[begin:]
        starts = np.stack([self._carried(before, begin), *self._recalled(values, padded)])
        found = recognise_all(
            network,
            shown_as(self.scene, [values], own_arm=begin == 0),
            starts=starts[None],
            settings=for_levels(settings.recognition, self.learner).model_copy(
                update={"iterations": iterations, "starts": RANDOM}
            ),
            key=jax.random.key(len(watched.path)),
            padded_to=(1, padded),
        )[0]
        first = values[0].copy()
        if begin:  # in the middle of a motion the arm is where it is recognised to be
            first[ARM] = found.path[0, ARM]
        hand = hand_seen(generate(network, found.initial_state, padded + self._stroke, first=first))
        earlier = before.path[:begin] if before is not None else watched.path[:0]
        return Understood(
            begin=begin,
            state=found.initial_state,
            first=first,
            path=np.concatenate([earlier, watched.path[len(earlier) : begin], hand[: len(values)]]),
            next=hand[len(values) : len(values) + self._stroke],
        )

    def _carried(self, before: Understood | None, begin: int) -> Float[ndarray, " N"]:
        """Return what was understood a moment ago, at the row where recognition begins."""
        network = self.learner.network
        if before is None or before.begin > begin or len(before.state) != network.size:
            return np.zeros(network.size)
        if before.begin == begin:
            return before.state
        y = activity(network, before.state, most_rows(self._manner), first=before.first)
        then = np.clip(y[begin - before.begin], SMALLEST, 1 - SMALLEST)
        return np.asarray(np.log(then / (1 - then)))

    def _recalled(self, values: Float[ndarray, "W 6"], padded: int) -> Float[ndarray, "R N"]:
        """Return the initial states of the learned motions that are nearest to what is seen."""
        network = self.learner.network
        known = [e.initial_state for e in self.learner.experiences[-MEMORY:]]
        states = np.zeros((MEMORY, network.size))
        states[: len(known)] = known or 0.0
        first = np.repeat(values[:1], MEMORY, axis=0)
        here = dict(zip(self.scene.body.channels.names, values[0], strict=True))
        paths = hand_seen(generate(network, placed(network, states, here), padded, first=first))
        apart = np.linalg.norm(paths[:, : len(values)] - hand_seen(values), axis=-1).mean(1)
        apart[max(len(known), RECALLED) :] = np.inf
        return states[np.argsort(apart, kind="stable")[:RECALLED]]
