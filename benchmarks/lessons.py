"""Lessons one after the other: does one ever leave the robot worse than it began?

A robot that has babbled is shown its five strokes by the scripted caregiver and has a lesson on
each, then all over again, and at half of that its slow level opens. Before and after every lesson
what the robot misses by is measured from outside, as a person would: a motion is shown and
imitated. A lesson is worse where the motion taught is, or the mean over all that was taught.

    python benchmarks/lessons.py                # or so many seeds
"""

import os
import sys
from time import monotonic

from motionese.one_core import one_core

os.environ.update(one_core())

import numpy as np
from rich.console import Console

from motionese.experiment import read_settings
from motionese.imitation import Scene, babbled, generator_for, newborn
from motionese.teaching.session import Teaching

ROUNDS, SEEDS = 2, range(100, 105)


def nothing(*progress: object) -> None:
    """Be told, and do nothing."""


def missed(teaching: Teaching, paths: dict[str, np.ndarray]) -> dict[str, float]:
    """Return what an imitation of every path misses by now [cm]; the session stays as it is."""
    other, errors = Teaching(teaching.scene, teaching.learner), {}
    for motion, path in paths.items():
        other.show(path, "scripted")
        errors[motion] = other.imitate().error_cm
    return errors


def lessons_of(seed: int, console: Console) -> list[bool]:
    """Return of every lesson of a robot whether it left it worse."""
    scene = Scene(read_settings(), seed)
    teaching = Teaching(scene, babbled(scene, newborn(scene, 2)))
    paths: dict[str, np.ndarray] = {}
    worse = []
    for part in range(ROUNDS):
        if part:
            teaching.grow(nothing)
        for sequence in scene.task.sequences(1):
            rng = generator_for(seed, "benchmark", part)
            paths[sequence.name] = scene.caregiver().demonstrate(sequence, rng).path
            before = missed(teaching, paths)
            teaching.show(paths[sequence.name], "scripted")
            began = monotonic()
            lesson = teaching.learn(nothing)
            took, after = monotonic() - began, missed(teaching, paths)
            means = [float(np.mean([*errors.values()])) for errors in (before, after)]
            taught = before[sequence.name], after[sequence.name]
            worse.append(taught[1] > taught[0] or means[1] > means[0])
            console.print(
                f"{seed} {sequence.name}: {taught[0]:.2f} → {taught[1]:.2f} cm, all "
                f"{means[0]:.2f} → {means[1]:.2f} cm, kept {lesson.kept}, {took:.1f} s"
                + (", WORSE" if worse[-1] else "")
            )
    return worse


def main() -> None:
    """Teach robots of the seeds that are given, and count."""
    console = Console(markup=False, highlight=False)
    worse = [each for seed in sys.argv[1:] or SEEDS for each in lessons_of(int(seed), console)]
    console.print(f"{sum(worse)} of {len(worse)} lessons left the robot worse than it was")


if __name__ == "__main__":
    main()
