"""How much of what a level is for has emerged in it, as a share, after any loop.

The fastest context level is to hold the primitives. Its map of initial states is what lies between
those of every two primitives: a point nearer to one's Cf_0 than to the other's should make its
stroke. The share of such points from which the hand stays, on average, within a fifth of the
stroke's extent of the one's way is 1 where primitives are clear: categories with an edge between.

A level above is to hold what comes after another, and to leave the strokes alone. Over the map of
its own initial states (the paper's Fig. 10) a primitive should keep its way; and where the lesson
asks for memory of order, exchanged initial states (`exchanged`) should lead where the level's own
say. The share is the smaller of the two.
"""

from collections.abc import Sequence
from itertools import permutations

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.learner import Learner
from motionese.imitation.roles.exchange import exchanged
from motionese.imitation.roles.recognised import (
    RecognisedDemonstration,
    RecognisedLesson,
    recognised,
)
from motionese.imitation.scene import Scene
from motionese.imitation.strokes import stroke
from motionese.learning import generate
from motionese.task import PrimitiveSequence

BETWEEN = (0.0, 0.1, 0.2, 0.3, 0.4)
"""How far a point lies from a primitive's initial state towards another's."""
ASTRAY = 0.2
"""A way is another one from this mean distance on, as a share of the primitive's extent."""


def share_emerged(
    scene: Scene, learner: Learner, lesson: Sequence[PrimitiveSequence], level: str, loop: int
) -> float:
    """Return the share of what a level is for that has emerged after a loop.

    Args:
        scene: Robot and caregiver, who shows everything anew.
        learner: What the robot has become.
        lesson: What it is taught.
        level: A context level that is open.
        loop: The loop's number.
    """
    settings, occasion = scene.settings.evaluation.repertoire, f"emergence {loop}"
    alone = recognised(scene, learner, scene.task.sequences(1), settings, 1, occasion)
    place = learner.network.names.index(level)
    if place == 1:
        return _clear(alone, _between(alone, level))
    clear = _clear(alone, _over_map(scene, alone, level))
    shown = recognised(scene, learner, lesson, settings, 1, occasion)
    below = learner.network.names[place - 1]
    order = [
        row["follows"] == "upper"
        for row in exchanged(shown)
        if row["kind"] == "order" and row["split"] == below
    ]
    return min(clear, float(np.mean(order))) if order else clear


Points = list[tuple[RecognisedDemonstration, Float[ndarray, " N"]]]
"""Whose stroke an initial state should make, and that state."""


def _between(alone: RecognisedLesson, level: str) -> Points:
    units, points = alone.network.units(level), []
    for own, other in permutations(alone.usable, 2):
        for share in BETWEEN:
            state = own.initial_state.copy()
            state[units] += share * (other.initial_state[units] - state[units])
            points.append((own, state))
    return points


def _over_map(scene: Scene, alone: RecognisedLesson, level: str) -> Points:
    settings, units = scene.settings.evaluation, alone.network.units(level)
    varied = np.arange(units.start, units.stop)[:2]
    axis = np.linspace(-settings.map_range, settings.map_range, settings.map_points)
    grid = np.stack(np.meshgrid(*[axis] * len(varied)), axis=-1).reshape(-1, len(varied))
    points = []
    for own in alone.usable:
        states = np.tile(own.initial_state, (len(grid), 1))
        states[:, varied] = grid
        points += [(own, state) for state in states]
    return points


def _clear(alone: RecognisedLesson, points: Points) -> float:
    """Return the share of points from which the network makes the stroke that it should make."""
    if not points:
        return 0.0
    rows = max(len(own.seen) for own, _ in points)
    states, firsts = (np.array([p[1] for p in points]), np.array([p[0].first for p in points]))
    made = alone.bearing(generate(alone.network, states, rows, first=firsts))
    return float(np.mean([_goes(own, path) for (own, _), path in zip(points, made, strict=True)]))


def _goes(own: RecognisedDemonstration, path: Float[ndarray, "_ 2"]) -> bool:
    """Whether a seen hand's path [rad] goes a demonstration's way."""
    apart = np.linalg.norm(path[: len(own.seen)] - own.seen, axis=1)
    extent = stroke(own.seen[0], own.seen[-1])[1]
    return bool(np.nanmean(apart) < ASTRAY * extent)
