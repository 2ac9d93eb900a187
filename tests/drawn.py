"""A person at the page: drawings of motions, in the view and as messages."""

from functools import cache
from itertools import pairwise

import numpy as np

from motionese.body import open_body
from motionese.experiment import read_settings
from motionese.task import PUSHING_BUTTONS
from motionese.teaching.view import View

HZ = 60


@cache
def view() -> View:
    """The view of the robot that pushes buttons."""
    return View(open_body(read_settings().body, PUSHING_BUTTONS), PUSHING_BUTTONS)


def places(name: str) -> list[np.ndarray]:
    """Where the places of a sequence are in the view."""
    task = PUSHING_BUTTONS
    return [view().of_points(task.position(place)) for place in task.sequence(name).places]


def points_of(
    name: str, seconds: float = 1.2, seed: int = 0, rests: tuple[float, float] = (0.1, 0.3)
) -> list[tuple[float, float, float]]:
    """A motion as a trembling hand draws it: bowed strokes of uneven length, with pauses [s]."""
    rng = np.random.default_rng(seed)
    corners, way = places(name), []
    for start, end in pairwise(corners):
        count = int(seconds * rng.uniform(0.8, 1.2) * HZ)
        share = np.arange(count)[:, None] / count
        eased = share**3 * (10 - 15 * share + 6 * share**2)
        way.append(start + eased * (end - start) + np.sin(np.pi * share) * rng.normal(0, 0.01, 2))
        way.append(np.repeat(end[None], int(rng.uniform(*rests) * HZ), axis=0))
    drawn = np.concatenate(way)
    drawn = drawn + rng.normal(0, 0.001, drawn.shape)
    return [(1000 * row / HZ, float(x), float(y)) for row, (x, y) in enumerate(drawn)]


def pen(phase: str, points=(), **more) -> dict:
    """A message of the pen."""
    return {"type": "pen", "phase": phase, "points": [list(point) for point in points], **more}


def strokes(name: str, size: int = 20, **how) -> list[dict]:
    """The messages of a whole drawing."""
    points = points_of(name, **how)
    parts = [points[i : i + size] for i in range(1, len(points), size)]
    return [pen("down", points[:1]), *(pen("move", part) for part in parts), pen("up")]
