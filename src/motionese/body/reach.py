r"""Which points the robot's marker reaches, and with which arm angles.

The marker is rigid to the arm at m = (a, 0, c), and both joint axes meet in the shoulder s, so

    marker = s + R_y(shoulder) R_z(armpit) m

lies on the sphere of radius |m| around s: the arm reaches a surface, not a volume.
"""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body.arm import COMMAND_RANGE
from motionese.errors import TaskError

SHOULDER = np.array([0.0, -0.18, 1.07])
"""Where the two axes of the arm meet [m, world]."""
MARKER_ON_ARM = np.array([0.53, 0.0, 0.057])
"""The marker in the arm's own frame [m]: a along it, 0 across it, c above it."""
REACH_M = float(np.linalg.norm(MARKER_ON_ARM))
"""Distance of the marker from the shoulder [m]."""


def marker_at(arm: Float[ndarray, "*shape 2"]) -> Float[ndarray, "*shape 3"]:
    """Return where the marker is [m, world] when the arm stands at these angles [rad]."""
    shoulder, armpit = np.moveaxis(np.asarray(arm, dtype=np.float64), -1, 0)
    a, _, c = MARKER_ON_ARM
    ahead = a * np.cos(armpit)
    x = ahead * np.cos(shoulder) + c * np.sin(shoulder)
    z = -ahead * np.sin(shoulder) + c * np.cos(shoulder)
    marker: Float[ndarray, "*shape 3"] = SHOULDER + np.stack([x, a * np.sin(armpit), z], axis=-1)
    return marker


def projected(path: Float[ndarray, "*shape 3"]) -> Float[ndarray, "*shape 3"]:
    """Return the points [m, world] that the arm could reach nearest to those of a path."""
    beyond = np.asarray(path, dtype=np.float64) - SHOULDER
    distance = np.linalg.norm(beyond, axis=-1, keepdims=True)
    reached: Float[ndarray, "*shape 3"] = SHOULDER + REACH_M * beyond / distance
    return reached


def on_reach(
    origin: Float[ndarray, "3"], rays: Float[ndarray, "*shape 3"]
) -> Float[ndarray, "*shape 3"]:
    """Return where rays from a point inside the surface that the marker moves on meet it [m]."""
    along = rays / np.linalg.norm(rays, axis=-1, keepdims=True)
    inside = np.asarray(origin) - SHOULDER
    half = along @ inside
    distance = -half + np.sqrt(half**2 + REACH_M**2 - inside @ inside)
    met: Float[ndarray, "*shape 3"] = origin + distance[..., None] * along
    return met


def arm_reaching(
    position: Float[ndarray, "3"], *, tolerance_m: float = 0.01, name: str = "the position"
) -> Float[ndarray, "2"]:
    """Return the arm angles [rad] that bring the marker nearest to a position [m, world].

    Args:
        position: Where the marker should be [m, world].
        tolerance_m: How far from it the marker may stay [m].
        name: What the position is called in the error's sentence, such as "corner UR".

    Raises:
        TaskError: The nearest angles that may be commanded leave the marker too far away.
    """
    a, _, c = MARKER_ON_ARM
    x, y, z = projected(position) - SHOULDER
    armpit = np.arcsin(np.clip(y / a, -1.0, 1.0))
    ahead = a * np.cos(armpit)
    angles = np.array([np.arctan2(c * x - ahead * z, ahead * x + c * z), armpit])
    arm = np.array(np.clip(angles, *COMMAND_RANGE))
    miss = float(np.linalg.norm(marker_at(arm) - position))
    if not miss <= tolerance_m:
        raise beyond_tolerance(name, position, miss, tolerance_m)
    return arm


def beyond_tolerance(
    name: str, position: Float[ndarray, "3"], miss_m: float, tolerance_m: float
) -> TaskError:
    """Return the error of a position [m] that the marker misses by more than its tolerance."""

    def point(p: Float[ndarray, "3"]) -> str:
        return f"({p[0]:.3f}, {p[1]:.3f}, {p[2]:.3f}) m"

    low, high = np.degrees(COMMAND_RANGE)
    return TaskError(
        f"{name} {point(position)} is {100 * miss_m:.1f} cm out of the arm's reach, "
        f"{100 * tolerance_m:g} cm are allowed: its marker moves {100 * REACH_M:.1f} cm around "
        f"{point(SHOULDER)}, above the table, shoulder {low[0]:g} to {high[0]:g}°, armpit "
        f"{low[1]:g} to {high[1]:g}°"
    )


CORNER_POSTURES: dict[str, Float[ndarray, "2"]] = {
    "UR": np.radians([8.0, -12.6]),
    "UL": np.radians([8.0, 12.6]),
    "LR": np.radians([33.9, -12.6]),
    "LL": np.radians([33.9, 12.6]),
}
"""Where the arm stands in the corners [rad]; it holds a button down in LR and LL, so the angles to
command there lie further down (`Actroid.command_reaching`)."""

CORNERS: dict[str, Float[ndarray, "3"]] = {
    corner: marker_at(posture) for corner, posture in CORNER_POSTURES.items()
}
"""Where the marker is in the corners [m, world]: upper and lower, right and left of the robot."""
