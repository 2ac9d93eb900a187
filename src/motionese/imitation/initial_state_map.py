"""The map of the slow initial states (the paper's Fig. 10).

A primitive's initial state is held but for its two slowest units, which run over a grid.
"""

from itertools import pairwise

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.learner import Learner
from motionese.imitation.loop import Row, imitate
from motionese.imitation.scene import Scene
from motionese.imitation.strokes import stroke
from motionese.learning import generate
from motionese.network import MTRNN
from motionese.task import PrimitiveSequence


def has_map(scene: Scene, network: MTRNN) -> bool:
    """Whether a network's slowest level is open, above a fast one, and has two units at least."""
    top = network.levels[-1]
    slowest = list(scene.settings.network.levels)[-1]
    return top.name == slowest and len(network.levels) > 2 and top.size >= 2


def map_slow_states(scene: Scene, learner: Learner) -> list[Row]:
    """Let the network generate motions from each primitive's state over a grid of slow ones.

    Every primitive's state is recognised from one demonstration. Directions are those of the hand
    as the robot sees it: 0 rad to the robot's right, π/2 upwards.

    Returns:
        A row per primitive and grid point; none where there is no slow level of two units.
    """
    if not has_map(scene, learner.network):
        return []
    settings = scene.settings.evaluation
    rows: list[Row] = []
    for each in imitate(scene, learner, scene.task.sequences(1), settings.recognition, "map"):
        first = scene.as_own(each.sequence.start, each.watched)[0]
        state = each.found.initial_state
        rows += slow_map_of(scene, learner.network, each.sequence, state, first)
    return rows


def with_slow_state(
    network: MTRNN, state: Float[ndarray, " N"], slow: Float[ndarray, "*shape 2"]
) -> Float[ndarray, "*shape N"]:
    """Return initial states whose first two units of the top level are set to given values."""
    first = network.size - network.levels[-1].size
    states = np.broadcast_to(state, (*slow.shape[:-1], network.size)).copy()
    states[..., first : first + 2] = slow
    return states


def slow_map_of(
    scene: Scene,
    network: MTRNN,
    primitive: PrimitiveSequence,
    state: Float[ndarray, " N"],
    first: Float[ndarray, " D"],
) -> list[Row]:
    """Return the map's rows of one primitive.

    Args:
        scene: Robot and caregiver.
        network: The robot's network.
        primitive: Whose map it is.
        state: The primitive's initial state, which is held but for the slowest level.
        first: The first row of a demonstration, as the own body would sense it.
    """
    settings, level = scene.settings.evaluation, network.levels[-1].name
    axis = np.linspace(-settings.map_range, settings.map_range, settings.map_points)
    grid = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    states = with_slow_state(network, state, grid)
    segments = strokes_from(scene, network, primitive, states, first)
    rows = []
    for point, *strokes in zip(grid, *segments, strict=True):
        row: Row = {"primitive": primitive.name}
        row |= {f"{level}_1": point[0], f"{level}_2": point[1]}
        for number, (direction, extent) in enumerate(strokes, start=1):
            row |= {f"direction_{number}_rad": direction, f"extent_{number}_rad": extent}
        rows.append(row)
    return rows


def strokes_from(
    scene: Scene,
    network: MTRNN,
    primitive: PrimitiveSequence,
    states: Float[ndarray, "G N"],
    first: Float[ndarray, " D"],
) -> Float[ndarray, "2 G 2"]:
    """Return direction [rad] and extent [rad] of two strokes that a network makes from states.

    Args:
        scene: Robot and caregiver.
        network: The robot's network.
        primitive: As long as this is either stroke.
        states: Initial states of all levels.
        first: The first row, as the own body senses it.
    """
    length, second = scene.manner.rows(primitive), scene.manner.rows_until_next(primitive)
    firsts = np.repeat(first[None], len(states), axis=0)
    seen = scene.body.bearing(generate(network, states, second + length, first=firsts))
    corners = [seen[:, row] for row in (0, second - 1, second + length - 1)]
    return np.stack([stroke(begin, end) for begin, end in pairwise(corners)])
