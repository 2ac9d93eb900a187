"""The forward model of the own body: where the own hand will be seen, by what is commanded.

It knows nothing of the body but what was lived through: in every experience the seen hand's bearing
(azimuth, elevation) followed from the commanded joint angles c. Since the arm gives way and lags,
it is taken as linear in c, its last two changes, and the products of c, by least squares.
"""

from collections.abc import Iterable

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import SimulatedRobot
from motionese.imitation import Experience, Scene
from motionese.teaching.view import position_seen

RIDGE = 1e-4
"""Keeps small what few experiences leave open; angles are in rad."""


class ForwardModel:
    """Expects where the own hand goes."""

    def __init__(self, scene: Scene, experiences: Iterable[Experience]) -> None:
        """Learn from experiences; there must be one."""
        self._body: SimulatedRobot = scene.body
        causes, seen = [], []
        for each in experiences:
            cause, bearing = _causes(each.values[:, scene.joints]), scene.body.bearing(each.values)
            known = np.isfinite(cause).all(1) & np.isfinite(bearing).all(1)
            causes.append(cause[known])
            seen.append(bearing[known])
        x, y = np.concatenate(causes), np.concatenate(seen)
        self._weights = np.linalg.solve(x.T @ x + RIDGE * np.eye(x.shape[1]), x.T @ y)

    def hand(self, commands: Float[ndarray, "T J"]) -> Float[ndarray, "T 3"]:
        """Return the path [m, world] on which the own hand is expected under commands [rad]."""
        return position_seen(self._body, _causes(commands) @ self._weights)


def _causes(commands: Float[ndarray, "T J"]) -> Float[ndarray, "T C"]:
    """Return 1, the commands, their changes of the last two rows, and their products."""
    changes = np.diff(commands, axis=0, prepend=commands[:1])
    earlier = np.concatenate([changes[:1], changes[:-1]])
    one, other = np.triu_indices(commands.shape[1])
    products = commands[:, one] * commands[:, other]
    return np.concatenate(
        [np.ones((len(commands), 1)), commands, changes, earlier, products], axis=1
    )
