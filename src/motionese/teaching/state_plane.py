"""A plane in the initial states of a level, over which a map is drawn."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import Learner

RIM = 1.2
"""A map reaches so many times as far as the farthest state that was learned."""


@dataclass(frozen=True)
class StatePlane:
    """Two directions in the initial states of the highest open level.

    Attributes:
        level: The level's name.
        slow: Whether it is above a fast one, as a map of the paper's Fig. 10 has it.
        units: Its units among those of all levels.
        axes: The directions, orthogonal and of unit length; of a slow level its first two units.
            [2, n]
        reach: How far the map goes along each, from −reach to reach.
    """

    level: str
    slow: bool
    units: slice
    axes: Float[ndarray, "2 n"]
    reach: float

    def coordinates(self, state: Float[ndarray, " N"]) -> Float[ndarray, "2"]:
        """Return where an initial state of all levels lies in the plane."""
        return np.asarray(self.axes @ state[self.units])

    def moved(
        self, state: Float[ndarray, " N"], to: Float[ndarray, "*shape 2"]
    ) -> Float[ndarray, "*shape N"]:
        """Return initial states that are held but for where they lie in the plane."""
        moved = np.broadcast_to(state, (*to.shape[:-1], len(state))).copy()
        moved[..., self.units] += (to - self.coordinates(state)) @ self.axes
        return moved


def plane_of(learner: Learner, reach: float) -> StatePlane:
    """Return the plane of a robot's map; it reaches so far, or farther where more was learned.

    Where there is no slow level it is one in the fast level's initial states: through 0, and as
    near as can be to those of all that was learned.
    """
    network = learner.network
    level = network.names[-1]
    units, size = network.units(level), network.levels[-1].size
    slow = len(network.levels) > 2
    learned = learner.repertoire()[:, units]
    axes = np.eye(2, size)
    if not slow and size > 1:
        # Of what nothing was learned about, single units are as good as any direction.
        axes = np.linalg.svd(np.vstack([learned, 1e-9 * np.eye(size)]))[2][:2]
    farthest = float(np.abs(learned @ axes.T).max())
    return StatePlane(level, slow, units, axes, max(reach, RIM * farthest))
