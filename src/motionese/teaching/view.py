"""The robot's fixed view, in which a person draws: pixels to positions of the hand, and back.

The gaze rests on the middle of the four corners. A drawn point is a ray from the eye; it means the
one point of that ray on the surface that the robot's hand can reach.
"""

import math

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.body import CORNERS, EYE_POSITION, arm_reaching, marker_at, on_reach

ASPECT = 4 / 3
"""Width of the view by its height."""
HEIGHT = math.radians(36.0)
"""Vertical field of view [rad]: narrower than the eye's own, so that strokes are large."""


class View:
    """A pinhole picture: x from 0 (left) to 1 (right), y from 0 (top) to 1 (bottom)."""

    def __init__(self) -> None:
        """Turn the eye to the middle of the corners."""
        ahead = np.mean(list(CORNERS.values()), axis=0) - EYE_POSITION
        ahead /= np.linalg.norm(ahead)
        right = np.cross(ahead, (0.0, 0.0, 1.0))
        right /= np.linalg.norm(right)
        self.axes: Float[ndarray, "3 3"] = np.stack([right, np.cross(right, ahead), ahead])
        """Right, up and ahead as unit vectors [world], a row each."""
        half = math.tan(HEIGHT / 2)
        self._half = np.array([half * ASPECT, half])

    def of_points(self, points: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 2"]:
        """Return where positions [m, world] are seen."""
        return self.of_rays(np.asarray(points, dtype=np.float64) - EYE_POSITION)

    def of_bearing(self, bearing: Float[ndarray, "*shape 2"]) -> Float[ndarray, "*shape 2"]:
        """Return where directions (azimuth, elevation) [rad], as `body.bearing` gives, are seen."""
        azimuth, elevation = np.moveaxis(np.asarray(bearing), -1, 0)
        level = np.cos(elevation)
        rays = [level * np.cos(azimuth), level * np.sin(azimuth), np.sin(elevation)]
        return self.of_rays(np.stack(rays, axis=-1))

    def of_rays(self, rays: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 2"]:
        """Return where rays from the eye [world] pass through the picture."""
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
        meant = on_reach(EYE_POSITION, rays)
        reached = np.array([marker_at(arm_reaching(p, tolerance_m=math.inf)) for p in meant])
        return reached, np.linalg.norm(reached - meant, axis=1) > 0.01
