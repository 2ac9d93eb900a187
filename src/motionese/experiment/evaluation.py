"""After the last loop: imitation of new motions, the map of the slow initial states, the inside.

Nothing is learned here.
"""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.body import bearing
from motionese.caregiver import PUSHING_BUTTONS, Motion
from motionese.experiment.imitation_loop import Imitated, Row, imitate
from motionese.experiment.learner import Learner
from motionese.experiment.scene import Scene
from motionese.learning import activity, generate
from motionese.network import MTRNN

NEW_MOTIONS = PUSHING_BUTTONS.sequences(3)
Lessons = tuple[tuple[Motion, ...], ...]
LOOKED_INTO = PUSHING_BUTTONS.motion("UR ↓↑←")
"""The motion whose performance is kept with everything that went on inside."""
SLOW, PRIMITIVES = "cs", PUSHING_BUTTONS.sequences(1)


def imitate_new_motions(
    scene: Scene, learner: Learner, lessons: Lessons
) -> tuple[list[Row], list[Imitated]]:
    """Imitate every motion of three primitives once, by recognition alone.

    Args:
        scene: Robot and caregiver.
        learner: What the robot has become.
        lessons: What it was taught in each phase. A motion counts as trained if all its pairs were
            part of a lesson; one that was a lesson as a whole is no new motion.

    Returns:
        A row per new motion, and the imitations of all motions of three primitives.
    """
    taught = {motion for lesson in lessons for motion in lesson}
    pairs = {pair for motion in taught for pair in motion.pairs()}
    imitated = imitate(
        scene, learner, NEW_MOTIONS, scene.settings.evaluation.recognition, "new motions"
    )
    rows = [
        {
            "motion": each.motion.name,
            "trained": pairs.issuperset(each.motion.pairs()),
            **each.measures(scene),
            "status": each.found.status.ending.value,
        }
        for each in imitated
        if each.motion not in taught
    ]
    return rows, imitated


def map_slow_states(scene: Scene, learner: Learner) -> list[Row]:
    """Let the network generate motions from each primitive's Cf_0 over a grid of Cs_0 (Fig. 10).

    Every primitive's Cf_0 is recognised from one demonstration. Directions are those of the hand
    as the robot sees it: 0 rad to the robot's right, π/2 upwards.

    Returns:
        A row per primitive and grid point; none where there is no slow level of two units.
    """
    if not has_slow_map(learner.network):
        return []
    settings = scene.settings.evaluation
    rows: list[Row] = []
    for each in imitate(scene, learner, PRIMITIVES, settings.recognition, "map"):
        first = scene.as_own(each.motion, each.watched)[0]
        rows += slow_map_of(scene, learner.network, each.motion, each.found.initial_state, first)
    return rows


def has_slow_map(network: MTRNN) -> bool:
    """Whether a network has a slow level of at least two units."""
    sizes = {level.name: level.size for level in network.levels}
    return sizes.get(SLOW, 0) >= 2


def with_slow_state(
    network: MTRNN, state: Float[ndarray, " N"], slow: Float[ndarray, "*shape 2"]
) -> Float[ndarray, "*shape N"]:
    """Return initial states whose first two slow units are set to given values."""
    first_two = range(*network.units(SLOW).indices(network.size))[:2]
    states = np.broadcast_to(state, (*slow.shape[:-1], network.size)).copy()
    states[..., first_two] = slow
    return states


def slow_map_of(
    scene: Scene,
    network: MTRNN,
    primitive: Motion,
    state: Float[ndarray, " N"],
    first: Float[ndarray, "6"],
) -> list[Row]:
    """Return the map's rows of one primitive.

    Args:
        scene: Robot and caregiver.
        network: The robot's network.
        primitive: Whose map it is.
        state: The primitive's initial state, whose Cf_0 is held.
        first: The first row of a demonstration, as the own body would sense it.
    """
    settings = scene.settings.evaluation
    axis = np.linspace(-settings.map_range, settings.map_range, settings.map_points)
    grid = np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1).reshape(-1, 2)
    length = scene.settings.caregiver.rows(primitive)
    states = with_slow_state(network, state, grid)
    firsts = np.repeat(first[None], len(grid), axis=0)
    seen = bearing(generate(network, states, 2 * length, first=firsts))
    segments = [_strokes(seen, 0, length - 1), _strokes(seen, length - 1, 2 * length - 1)]
    rows = []
    for point, *strokes in zip(grid, *segments, strict=True):
        row: Row = {"primitive": primitive.name, "cs_1": point[0], "cs_2": point[1]}
        for number, (direction, extent) in enumerate(strokes, start=1):
            row |= {f"direction_{number}_rad": direction, f"extent_{number}_rad": extent}
        rows.append(row)
    return rows


def _strokes(seen: Float[ndarray, "G T 2"], begin: int, end: int) -> Float[ndarray, "G 2"]:
    """Return direction [rad] and extent [rad] of the seen hand's way between two rows."""
    azimuth, elevation = np.moveaxis(seen[:, end] - seen[:, begin], -1, 0)
    right = -azimuth * np.cos(seen[:, begin, 1])
    return np.stack([np.arctan2(elevation, right), np.hypot(right, elevation)], axis=-1)


def inside(scene: Scene, learner: Learner, imitated: Sequence[Imitated]) -> dict[str, ndarray]:
    """Return what is kept of the performances: hands' paths of all, everything of one.

    Returns:
        `shown.MOTION` and `performed.MOTION`, paths [m] [T, 3]; of `LOOKED_INTO` also `activity`
        (y of all units [T, N]), `commanded` and `sensed` arm angles [rad] [T, 2], `depths` [mm]
        and `poses`.
    """
    kept: dict[str, ndarray] = {}
    for each in imitated:
        done = each.performance
        kept[f"shown.{each.motion.name}"] = each.watched.path
        kept[f"performed.{each.motion.name}"] = done.path
        if each.motion == LOOKED_INTO:
            first = done.experience(scene.settings.imitation.efference_copy)[0]
            kept |= {
                "activity": activity(
                    learner.network, each.found.initial_state, len(done.path), first=first
                ),
                "commanded": done.commanded,
                "sensed": done.sensed[:, :2],
                "depths": done.depths,
                "poses": done.poses,
            }
    return kept
