"""Ways: how a hand gets from one place to another, as functions of the share of the way done."""

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float
from numpy import ndarray


@runtime_checkable
class Way(Protocol):
    """A way from place to place; hashable, so that primitives are."""

    def __call__(
        self, share: Float[ndarray, " S"], start: Float[ndarray, "3"], end: Float[ndarray, "3"]
    ) -> Float[ndarray, "S 3"]:
        """Return positions [m, world] at shares of the way, 0 at `start` and 1 at `end`."""


def straight(
    share: Float[ndarray, " S"], start: Float[ndarray, "3"], end: Float[ndarray, "3"]
) -> Float[ndarray, "S 3"]:
    """The straight way."""
    return np.asarray(start + share[:, None] * (end - start))


@dataclass(frozen=True)
class Arc:
    """A circular arc through an angle [rad], right-handed about an axis.

    The axis [world] is perpendicular to the arc's plane, hence to the straight way.
    """

    angle: float
    axis: tuple[float, float, float]

    def __call__(
        self, share: Float[ndarray, " S"], start: Float[ndarray, "3"], end: Float[ndarray, "3"]
    ) -> Float[ndarray, "S 3"]:
        """Return positions [m, world] at shares of the arc."""
        normal = np.asarray(self.axis) / np.linalg.norm(self.axis)
        half = (end - start) / 2
        # The centre lies on the chord's bisector: c = middle + (n × half) / tan(angle / 2).
        centre = start + half + np.cross(normal, half) / np.tan(self.angle / 2)
        radius = start - centre
        turned = self.angle * share[:, None]
        aside = np.cross(normal, radius)
        return np.asarray(centre + np.cos(turned) * radius + np.sin(turned) * aside)


@dataclass(frozen=True)
class ViaPoints:
    """Straight pieces through offsets [m, world] from the straight way, at evenly spaced shares."""

    points: tuple[tuple[float, float, float], ...]

    def __call__(
        self, share: Float[ndarray, " S"], start: Float[ndarray, "3"], end: Float[ndarray, "3"]
    ) -> Float[ndarray, "S 3"]:
        """Return positions [m, world] at shares of the way."""
        offsets = np.array([(0.0, 0.0, 0.0), *self.points, (0.0, 0.0, 0.0)])
        at = np.linspace(0.0, 1.0, len(offsets))
        aside = np.stack([np.interp(share, at, column) for column in offsets.T], axis=-1)
        return np.asarray(straight(share, start, end) + aside)
