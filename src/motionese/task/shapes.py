"""Drawing shapes: triangle, rectangle and circle on an inclined board (strokes straight and arcs).

After K. Mochizuki, S. Nishide, H. G. Okuno, T. Ogata, *Developmental human-robot imitation learning
of drawing with a neuro dynamical system* (SMC 2013). All corners lie on one circle and are shared
by the shapes, so that the way on from a corner follows from the strokes before it, not from the
corner. New shapes mix straight strokes with arcs, or begin at another corner.
"""

from typing import Any

import numpy as np

from motionese.task.sequence import Place, Primitive, PrimitiveSequence
from motionese.task.task import Attempt, Outcome, Task
from motionese.task.way import Arc

MIDDLE = (0.5106, -0.18, 0.9332)
"""The board's middle, where the marker is [m, world]: 5 mm nearer than an Actroid's arm is long."""
RIGHT, UP, AWAY = (0.0, -1.0, 0.0), (0.2588, 0.0, 0.9659), (0.9659, 0.0, -0.2588)
"""The board's axes as the robot sees it: inclined by 15°, facing its shoulder."""
RADIUS_CM = 9.0139
"""Of the circle; the corners of the rectangle, 15 by 10 cm, lie on it too."""
CORNERS_CM = {
    "T": ((0.0, RADIUS_CM), "the top"),
    "UL": ((-7.5, 5.0), "the upper left"),
    "UR": ((7.5, 5.0), "the upper right"),
    "LR": ((7.5, -5.0), "the lower right"),
    "LL": ((-7.5, -5.0), "the lower left"),
}
"""To the right and upwards of the middle [cm], and in words."""


def trace(sequence: PrimitiveSequence, attempt: Attempt) -> dict[str, Any]:
    """Return how far the drawn line is from the shown one, and from being closed [cm].

    The distance of lines is the mean, over the points of each, of the distance to the nearest
    point of the other: when a point was drawn does not matter.
    """
    apart = 100 * np.linalg.norm(attempt.path[:, None] - attempt.shown[None], axis=-1)
    gap = 100 * float(np.linalg.norm(attempt.path[-1] - attempt.path[0]))
    closed = sequence.places[-1] == sequence.start
    return {
        "line_error_cm": float((apart.min(0).mean() + apart.min(1).mean()) / 2),
        "closure_cm": gap if closed else np.nan,
    }


def _on_board(right_cm: float, up_cm: float) -> tuple[float, float, float]:
    aside = (right_cm * np.array(RIGHT) + up_cm * np.array(UP)) / 100
    x, y, z = (np.array(MIDDLE) + aside).tolist()
    return x, y, z


def _clockwise(start: str, end: str) -> Arc:
    """Return the arc of the circle from corner to corner, clockwise as the robot sees it."""
    (a, b), (c, d) = CORNERS_CM[start][0], CORNERS_CM[end][0]
    turned = (np.arctan2(b, a) - np.arctan2(d, c)) % (2 * np.pi)
    return Arc(float(turned), AWAY)


SHAPES = Task(
    name="shapes",
    title="drawing shapes",
    places={name: Place(name, _on_board(*at), title) for name, (at, title) in CORNERS_CM.items()},
    primitives=(
        Primitive("DOWN-RIGHT", "↘", "T", "LR", "down to the right"),
        Primitive("BASE", "←", "LR", "LL", "to the left"),
        Primitive("UP-RIGHT", "↗", "LL", "T", "up to the right"),
        Primitive("LID", "→", "UL", "UR", "to the right"),
        Primitive("DOWN", "↓", "UR", "LR", "down"),
        Primitive("UP", "↑", "LL", "UL", "up"),
        Primitive("ARC-DOWN", "◝", "T", "LR", "round to the right", _clockwise("T", "LR")),
        Primitive("ARC-BASE", "◡", "LR", "LL", "round below", _clockwise("LR", "LL")),
        Primitive("ARC-UP", "◜", "LL", "T", "round to the top", _clockwise("LL", "T")),
    ),
    achieved=trace,
    outcomes=(
        Outcome("line_error_cm", "distance from the shown line", "cm"),
        Outcome("closure_cm", "gap between begin and end", "cm"),
    ),
    lessons={"shapes": ("T ↘←↗", "UL →↓←↑", "T ◝◡◜")},
    novel={"new_shapes": ("T ◝←↗", "T ↘◡↗", "T ↘←◜", "T ◝◡↗", "UL →↓◡↑", "LR ←↗↘", "LR ◡◜◝")},
    fixtures="""
        <mujoco model="shapes">
          <worldbody>
            <geom name="board" type="box" size="0.004 0.16 0.14" pos="0.545 -0.18 0.924"
                  euler="0 15 0" rgba="0.93 0.93 0.90 0.35" contype="0" conaffinity="0" mass="0"/>
            <geom name="easel" type="box" size="0.012 0.012 0.40" pos="0.575 -0.18 0.40"
                  rgba="0.45 0.47 0.50 1" contype="0" conaffinity="0" mass="0"/>
          </worldbody>
        </mujoco>
    """,
)
"""Triangle, rectangle, circle."""
