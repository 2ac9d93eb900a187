r"""Directions over the map of the slow initial states: how uniform they are, and what sets them.

Directions θ_pg of primitive p's Cf_0 at grid point g of Cs_0 are taken as unit vectors
z_pg = (cos θ_pg, sin θ_pg), so that the mean of −π and π is not 0. One vector stands for each pair,
so this is a two-way analysis of variance without replication:

    total      Σ_pg |z_pg − z̄|²
    by Cf_0    G Σ_p |z̄_p − z̄|²      z̄_p the mean over the map
    by Cs_0    P Σ_g |z̄_g − z̄|²      z̄_g the mean over the primitives
    together   by Cf_0 + by Cs_0, what they explain additively

What is left is their interaction: Cs_0 acting otherwise with one primitive's Cf_0 than with
another's. All that Cs_0 takes part in is therefore 1 − by Cf_0.
"""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.strokes import WITHIN
from motionese.task import Task


class Shares(NamedTuple):
    """Shares of the direction's variance, explained by Cf_0 alone and by Cs_0 alone."""

    by_held: float
    by_varied: float

    @property
    def together(self) -> float:
        """What both explain additively."""
        return self.by_held + self.by_varied


def resultant_length(directions: Float[ndarray, "*shape G"]) -> Float[ndarray, "*shape"]:
    """Return the mean resultant length over the map: 1 if all directions are one, 0 if uniform."""
    return np.asarray(np.abs(np.exp(1j * directions).mean(axis=-1)))


def direction_shares(directions: Float[ndarray, "P G"]) -> Shares:
    """Return what Cf_0 (rows) and Cs_0 (columns) explain of the directions' variance.

    NaN where all directions are one: there is no variance to explain.
    """
    z = np.exp(1j * directions)
    total = (np.abs(z - z.mean()) ** 2).sum()
    if total < 1e-12 * z.size:
        return Shares(float("nan"), float("nan"))
    primitives, points = z.shape
    by_held = points * (np.abs(z.mean(axis=1) - z.mean()) ** 2).sum() / total
    by_varied = primitives * (np.abs(z.mean(axis=0) - z.mean()) ** 2).sum() / total
    return Shares(float(by_held), float(by_varied))


def share_within(directions: Float[ndarray, " G"], true: Sequence[float]) -> float:
    """Return the share of directions [rad] that lie within 45° of one of the true ones."""
    turned = directions[:, None] - np.asarray(true, dtype=np.float64)
    off = np.abs(np.angle(np.exp(1j * turned)))
    return float((off.min(axis=1) <= WITHIN).mean())


def true_strokes(
    task: Task, eye_position: Float[ndarray, "3"]
) -> Mapping[str, tuple[float, float]]:
    """Return every primitive's direction [rad] and extent [rad] as seen from the robot's eye.

    0 rad points to the robot's right, π/2 upwards.
    """
    strokes = {}
    for sequence in task.sequences(1):
        (x0, y0, z0), (x1, y1, z1) = (task.position(p) - eye_position for p in sequence.places)
        elevation = np.arctan2(z0, np.hypot(x0, y0))
        up = np.arctan2(z1, np.hypot(x1, y1)) - elevation
        right = (np.arctan2(y0, x0) - np.arctan2(y1, x1)) * np.cos(elevation)
        strokes[sequence.name] = (float(np.arctan2(up, right)), float(np.hypot(up, right)))
    return strokes


def following(task: Task, primitive: str) -> tuple[str, ...]:
    """Return the primitives that may follow one, by the names of their sequences."""
    end = task.sequence(primitive).places[-1]
    return tuple(s.name for s in task.sequences(1) if s.start == end)
