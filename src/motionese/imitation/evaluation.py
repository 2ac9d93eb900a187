"""After the last loop: imitation of sequences that were never taught. Nothing is learned here."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy import ndarray

from motionese.imitation.learner import Learner
from motionese.imitation.loop import Imitation, Row, imitate
from motionese.imitation.scene import Scene
from motionese.task import PrimitiveSequence, Task

ERRORS = ("imitation_error_cm", "recognition_residual_cm")
"""Measures that are taken of a new sequence sought in the other ways as well."""


def imitate_novel(
    scene: Scene,
    learner: Learner,
    novel: Sequence[PrimitiveSequence],
    taught: Iterable[PrimitiveSequence],
) -> tuple[list[Row], list[Imitation]]:
    """Imitate every new sequence by recognition alone, sought in three ways.

    A long search goes as far as it leads. A short one stays near what was learned, in any
    combination of its levels: it tells what is in the repertoire. In the third the fastest
    context level keeps what it has in the repertoire, and only the levels above are sought.

    Args:
        scene: Robot and caregiver.
        learner: What the robot has become.
        novel: The new sequences.
        taught: What it was taught, in all stages. A sequence counts as trained if all its pairs
            were part of a lesson; one that was a lesson as a whole is not new.

    Returns:
        A row per new sequence, and the imitations of all of them.
    """
    taught = set(taught)
    pairs = {pair for sequence in taught for pair in sequence.pairs()}
    settings = scene.settings.evaluation
    occasion = "new motions"
    imitated = imitate(scene, learner, novel, settings.recognition, occasion)
    ways = {"repertoire": settings.repertoire}
    if above := learner.network.names[2:]:
        ways["slow_alone"] = settings.repertoire.model_copy(update={"levels": above})
    others = {
        way: imitate(scene, learner, novel, recognition, occasion)
        for way, recognition in ways.items()
    }
    rows = [
        {
            "motion": each.sequence.name,
            "trained": pairs.issuperset(each.sequence.pairs()),
            **each.measures(scene),
            "status": each.found.status.ending.value,
            **{
                f"{way}_{name}": value
                for way, found in others.items()
                for name, value in _found(scene, found[i]).items()
            },
        }
        for i, each in enumerate(imitated)
        if each.sequence not in taught
    ]
    return rows, imitated


def _found(scene: Scene, each: Imitation) -> Row:
    measures = each.measures(scene)
    return {name: measures[name] for name in ERRORS} | {"status": each.found.status.ending.value}


def sample_sequence(task: Task) -> PrimitiveSequence | None:
    """Return the new sequence whose performance is kept with everything that went on inside.

    It is the first one of taught pairs, or the first of all; None for a task without new ones.
    """
    novel = [sequence for name in task.novel for sequence in task.lesson(name)]
    return next((s for s in novel if task.is_taught(s)), novel[0] if novel else None)


def kept_of(task: Task, imitated: Sequence[Imitation]) -> dict[str, ndarray]:
    """Return what is kept of performances: hands' paths of all, everything of one.

    Returns:
        `shown.NAME` and `performed.NAME`, paths [m] [T, 3]; of `sample_sequence` also `activity`
        (y of all units while it was performed [T, N]), `commanded` and `sensed` joint angles
        [rad] [T, J], `begins`, `poses`, and `effect.NAME` [T] of every effect.
    """
    kept: dict[str, ndarray] = {}
    sample = sample_sequence(task)
    for each in imitated:
        done = each.performance
        kept[f"shown.{each.sequence.name}"] = each.watched.path
        kept[f"performed.{each.sequence.name}"] = done.path
        if each.sequence == sample:
            kept |= {
                "activity": done.activity,
                "commanded": done.commanded,
                "sensed": done.sensed[:, done.joints],
                "begins": np.array(each.watched.begins),
                "poses": done.poses,
            }
            kept |= {f"effect.{name}": values for name, values in done.effects.items()}
    return kept
