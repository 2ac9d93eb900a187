"""The map of the slow initial states (the paper's Fig. 10) of a robot that is being taught."""

from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import generator_for, has_map, slow_map_of, with_slow_state
from motionese.learning import generate
from motionese.teaching.drawing import most_rows
from motionese.teaching.notebook import Notebook
from motionese.teaching.session import Teaching
from motionese.teaching.view import hand_seen

DIGITS = 3


class InteractiveMap:
    """The map, and the motion of every point of it.

    Attributes:
        level: The slowest level's name.
        axis: The values of its two first units' initial states, along both axes.
        grids: By primitive a row per grid point, the first unit's value changing slowest;
            `direction` [rad] (0 to the robot's right, π/2 upwards) and `extent` [rad].
        points: Where the learned motions lie: name, and the two units' initial states.
    """

    def __init__(self, teaching: Teaching) -> None:
        """Draw the map of a robot whose slow level is open (see `possible`)."""
        scene, network = teaching.scene, teaching.learner.network
        self._teaching = teaching
        # By primitive: its initial state, and how the own body senses a demonstration's first row.
        self._origins: dict[str, tuple[Float[ndarray, " N"], Float[ndarray, " D"]]] = {}
        settings = scene.settings.evaluation
        axis = np.linspace(-settings.map_range, settings.map_range, settings.map_points)
        self.level = network.levels[-1].name
        self.axis: list[float] = np.round(axis, DIGITS).tolist()
        self.grids: dict[str, list[dict[str, Any]]] = {}
        for primitive in scene.task.sequences(1):
            rng = generator_for(scene.seed, "map", primitive.name)
            watched = teaching.watch(scene.caregiver().demonstrate(primitive, rng))
            state = teaching.recogniser.at_the_end(watched).state
            first = scene.as_own(primitive.start, watched)[0]
            self._origins[primitive.name] = state, first
            self.grids[primitive.name] = [
                {of: round(row[f"{of}_1_rad"], DIGITS) for of in ("direction", "extent")}
                for row in slow_map_of(scene, network, primitive, state, first)
            ]
        slow = network.units(self.level)
        self.points = [
            (e.motion, np.round(e.initial_state[slow][:2], DIGITS).tolist())
            for e in teaching.learner.experiences
        ]

    @staticmethod
    def possible(teaching: Teaching) -> bool:
        """Whether the network has a slow level of two units."""
        return has_map(teaching.scene, teaching.learner.network)

    def named_as(self, notebook: Notebook) -> None:
        """Call the learned motions as they are called now."""
        self.points = [(notebook.called_now(motion), slow) for motion, slow in self.points]

    def motion(self, primitive: str, slow: tuple[float, float]) -> Float[ndarray, "T 3"] | None:
        """Return the hand's path [m, world] from a point, for two strokes; None if unknown."""
        if primitive not in self._origins:
            return None
        held, first = self._origins[primitive]
        scene, network = self._teaching.scene, self._teaching.learner.network
        manner = scene.settings.caregiver
        state = with_slow_state(network, held, np.array(slow))
        values = generate(network, state, most_rows(manner), first=first)
        return hand_seen(scene.body, values[: 2 * manner.primitive_rows])
