r"""Which points the robot's marker reaches, and with which arm angles.

The marker is rigid to the arm at m = (a, 0, c), and both joint axes meet in the shoulder s, so

    marker = s + R_y(shoulder) R_z(armpit) m

lies on the sphere of radius |m| around s: the arm reaches a surface, not a volume.
"""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

COMMAND_RANGE: Float[ndarray, "2 2"] = np.radians([[-10.0, -30.0], [50.0, 30.0]])
"""Lowest and highest angles [rad] of shoulder and armpit that may be commanded."""
SHOULDER = np.array([0.0, -0.18, 1.07])
"""Where the two axes of the arm meet [m, world]."""
MARKER_ON_ARM = np.array([0.53, 0.0, 0.057])
"""The marker in the arm's own frame [m]: a along it, 0 across it, c above it."""
REACH_M = float(np.linalg.norm(MARKER_ON_ARM))
"""Distance of the marker from the shoulder [m]."""
IN_WORDS = (
    f"its marker moves {100 * REACH_M:.1f} cm around "
    f"({SHOULDER[0]:.3f}, {SHOULDER[1]:.3f}, {SHOULDER[2]:.3f}) m, above the table, "
    "shoulder {:g} to {:g}°, armpit {:g} to {:g}°".format(*np.degrees(COMMAND_RANGE).T.flat)
)


def marker_at(angles: Float[ndarray, "*shape 2"]) -> Float[ndarray, "*shape 3"]:
    """Return where the marker is [m, world] when the arm stands at these angles [rad]."""
    shoulder, armpit = np.moveaxis(np.asarray(angles, dtype=np.float64), -1, 0)
    a, _, c = MARKER_ON_ARM
    ahead = a * np.cos(armpit)
    x = ahead * np.cos(shoulder) + c * np.sin(shoulder)
    z = -ahead * np.sin(shoulder) + c * np.cos(shoulder)
    return np.asarray(SHOULDER + np.stack([x, a * np.sin(armpit), z], axis=-1))


def projected(path: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
    """Return the points [m, world] of the whole surface nearest to those of a path."""
    beyond = np.asarray(path, dtype=np.float64) - SHOULDER
    distance = np.linalg.norm(beyond, axis=-1, keepdims=True)
    return np.asarray(SHOULDER + REACH_M * beyond / distance)


def reachable(path: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
    """Return the points [m, world] nearest to those of a path that angles in the range reach."""
    surface = projected(path)
    angles = _angles_of(surface)
    within = np.clip(angles, *COMMAND_RANGE)
    beyond = (angles != within).any(axis=-1, keepdims=True)
    return np.asarray(np.where(beyond, marker_at(within), surface))


def on_reach(
    origin: Float[ndarray, "3"], rays: Float[ndarray, "*shape 3"]
) -> Float[ndarray, "*shape 3"]:
    """Return where rays from a point inside the surface that the marker moves on meet it [m]."""
    along = rays / np.linalg.norm(rays, axis=-1, keepdims=True)
    inside = np.asarray(origin) - SHOULDER
    half = along @ inside
    distance = -half + np.sqrt(half**2 + REACH_M**2 - inside @ inside)
    return np.asarray(origin + distance[..., None] * along)


def arm_nearest(position: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 2"]:
    """Return the arm angles [rad], of those that may be commanded, nearest to a position [m]."""
    return np.array(np.clip(_angles_of(projected(position)), *COMMAND_RANGE))


def _angles_of(surface: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 2"]:
    """Return the arm angles [rad] at which the marker is at points of the surface [m, world]."""
    a, _, c = MARKER_ON_ARM
    x, y, z = np.moveaxis(surface - SHOULDER, -1, 0)
    armpit = np.arcsin(np.clip(y / a, -1.0, 1.0))
    ahead = a * np.cos(armpit)
    return np.stack([np.arctan2(c * x - ahead * z, ahead * x + c * z), armpit], axis=-1)
