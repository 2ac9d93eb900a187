"""The robot's fixed view, in which a person draws: pixels to positions of the hand, and back.

The gaze rests on the middle of the task's places. A drawn point is a ray from the eye; it means the
one point of that ray on the surface that the robot's hand can reach.
"""

import math

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.body import SimulatedRobot
from motionese.task import Task

ASPECT = 4 / 3
"""Width of the view by its height."""
HEIGHT = math.radians(36.0)
"""Vertical field of view [rad]: narrower than the eye's own, so that strokes are large."""
MARGIN = 0.1
"""Places keep this share of the picture clear of its rim; the field is wider where it must be."""


class View:
    """A pinhole picture: x from 0 (left) to 1 (right), y from 0 (top) to 1 (bottom).

    Attributes:
        axes: Right, up and ahead as unit vectors [world], a row each.
        height: Vertical field of view [rad].
    """

    def __init__(self, body: SimulatedRobot, task: Task) -> None:
        """Turn a robot's eye to the middle of a task's places."""
        self._body = body
        places = np.array([task.position(name) for name in task.places]) - body.eye_position
        ahead = places.mean(axis=0)
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        self.axes: Float[ndarray, "3 3"] = np.stack([right, np.cross(right, ahead), ahead])
        across, along, away = np.abs(places @ self.axes.T).T
        needed = np.max(np.maximum(along, across / ASPECT) / away) / (1 - 2 * MARGIN)
        half = max(math.tan(HEIGHT / 2), float(needed))
        self.height = 2 * math.atan(half)
        self._half = np.array([half * ASPECT, half])

    def of_points(self, points: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 2"]:
        """Return where positions [m, world] are seen."""
        rays = np.asarray(points, dtype=np.float64) - self._body.eye_position
        right, up, ahead = np.moveaxis(rays @ self.axes.T, -1, 0)
        ahead = np.maximum(ahead, 1e-3)
        plane = np.stack([right / ahead, -up / ahead], axis=-1)
        return np.asarray(0.5 + plane / self._half / 2)

    def positions(
        self, points: Float[ndarray, "T 2"]
    ) -> tuple[Float[ndarray, "T 3"], Bool[ndarray, " T"]]:
        """Return the hand's positions [m, world] that drawn points mean.

        Returns:
            The nearest positions that the arm reaches, and for which points that is elsewhere.
        """
        right, down = np.moveaxis((np.asarray(points) - 0.5) * 2 * self._half, -1, 0)
        rays = np.stack([right, -down, np.ones_like(right)], axis=-1) @ self.axes
        meant = self._body.met(rays)
        reached = self._body.reachable(meant)
        return reached, np.linalg.norm(reached - meant, axis=1) > 0.01


def hand_seen(
    body: SimulatedRobot, values: Float[ndarray, "*shape D"]
) -> Float[ndarray, "*shape 3"]:
    """Return where the hand is [m, world] that was seen with these channels' values."""
    return position_seen(body, body.bearing(values))


def position_seen(
    body: SimulatedRobot, bearing: Float[ndarray, "*shape 2"]
) -> Float[ndarray, "*shape 3"]:
    """Return where the hand is [m, world] that is seen at an azimuth and elevation [rad]."""
    azimuth, elevation = np.moveaxis(bearing, -1, 0)
    level = np.cos(elevation)
    rays = [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)]
    return body.met(np.stack(rays, axis=-1))
