"""The map of the slow initial states (the paper's Fig. 10) of a robot that is being taught."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.experiment.evaluation import (
    PRIMITIVES,
    SLOW,
    has_slow_map,
    slow_map_of,
    with_slow_state,
)
from motionese.experiment.keys import generator_for
from motionese.learning import generate
from motionese.teaching.drawing import most_rows
from motionese.teaching.reading import hand_seen
from motionese.teaching.session import Teaching

DIGITS = 3


@dataclass(frozen=True)
class Held:
    """A primitive whose Cf_0 is held while Cs_0 is varied."""

    state: Float[ndarray, " N"]
    first: Float[ndarray, "6"]


class SlowMap:
    """The map, and the motion of every point of it.

    Attributes:
        axis: The values of Cs_0 along both axes.
        grids: By primitive a row per grid point, the first slow unit's value changing slowest;
            `direction` [rad] (0 to the robot's right, π/2 upwards) and `extent` [rad].
        points: Where the learned motions lie: name, and Cs_0.
    """

    def __init__(self, teaching: Teaching) -> None:
        """Draw the map of a robot whose slow level is open (see `possible`)."""
        scene, network = teaching.scene, teaching.learner.network
        self._teaching, self._held = teaching, {}
        settings = scene.settings.evaluation
        axis = np.linspace(-settings.map_range, settings.map_range, settings.map_points)
        self.axis: list[float] = np.round(axis, DIGITS).tolist()
        self.grids: dict[str, list[dict[str, Any]]] = {}
        for motion in PRIMITIVES:
            rng = generator_for(scene.seed, "map", motion.name)
            watched = teaching.watch(scene.caregiver.demonstrate(motion, rng))
            state = teaching.recogniser.at_the_end(watched, None).state
            held = self._held[motion.name] = Held(state, scene.as_own(motion, watched)[0])
            self.grids[motion.name] = [
                {
                    "direction": round(row["direction_1_rad"], DIGITS),
                    "extent": round(row["extent_1_rad"], DIGITS),
                }
                for row in slow_map_of(scene, network, motion, state, held.first)
            ]
        slow = network.units(SLOW)
        self.points = [
            (e.motion, np.round(e.initial_state[slow][:2], DIGITS).tolist())
            for e in teaching.learner.experiences
        ]

    @staticmethod
    def possible(teaching: Teaching) -> bool:
        """Whether the network has a slow level of two units."""
        return has_slow_map(teaching.learner.network)

    def motion(self, primitive: str, slow: tuple[float, float]) -> Float[ndarray, "T 3"] | None:
        """Return the hand's path [m, world] from a point, for two strokes; None if unknown."""
        held = self._held.get(primitive)
        if held is None:
            return None
        network, manner = self._teaching.learner.network, self._teaching.scene.settings.caregiver
        state = with_slow_state(network, held.state, np.array(slow))
        values = generate(network, state, most_rows(manner), first=held.first)
        return hand_seen(values[: 2 * (manner.stroke_steps + manner.rest_steps)])
