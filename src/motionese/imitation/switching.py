"""Demonstrations that turn into another motion in mid-stroke, and when the robot notices."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy import ndarray

from motionese.caregiver import Demonstration
from motionese.imitation.following import recognised_while_shown
from motionese.imitation.keys import generator_for
from motionese.imitation.learner import Experience, Learner
from motionese.imitation.loop import Row
from motionese.imitation.performance import watch
from motionese.imitation.scene import Scene
from motionese.runtime import NONE, OnlineResult
from motionese.task import PrimitiveSequence

NEAR_M = 0.12
"""A motion is turned into where its way is as near as this [m]."""
TURN = 4
"""Rows that a turn takes."""
LEFT = 10
"""Rows that are left of the motion turned into, at least."""


@dataclass(frozen=True)
class Switch:
    """A demonstration that turns into another motion, and what the robot believed.

    Attributes:
        first: What it begins as.
        second: What it turns into.
        row: The row in which it turns.
        steps: Rows from there until the robot believes in the second motion's primitive; None if
            it never does.
        results: What the robot knew after every row.
    """

    first: PrimitiveSequence
    second: PrimitiveSequence
    row: int
    steps: int | None
    results: list[OnlineResult]

    def measures(self) -> Row:
        """Return a row of a table; without `steps` where the belief did not change."""
        names = {"first": self.first.name, "second": self.second.name, "row": self.row}
        return {**names, "steps": self.steps}

    def kept(self) -> dict[str, ndarray]:
        """Return what a figure needs: beliefs by sequence [T], the row of the turn, the steps."""
        steps = np.nan if self.steps is None else self.steps
        beliefs = {f"belief.{name}": share for name, share in self.belief().items()}
        return beliefs | {"switch": np.array([self.row, steps], dtype=float)}

    def belief(self) -> dict[str, ndarray]:
        """Return the belief in every sequence, and in none, against time. [T] each"""
        summed: dict[str, ndarray] = {}
        for row, result in enumerate(self.results):
            for name, share in result.belief.items():
                motion = sequence_of(name)
                summed.setdefault(motion, np.zeros(len(self.results)))[row] += share
        return summed


def sequence_of(name: str) -> str:
    """Return the sequence of an experience's name: 'UR ↓' of 'UR ↓ (loop 3)'."""
    return name.partition(" (")[0]


def switched(
    scene: Scene, learner: Learner, taught: Sequence[PrimitiveSequence], cases: int
) -> list[Switch]:
    """Show random demonstrations that turn in mid-stroke into another sequence that was taught.

    They turn where the other's way is nearest, into another primitive than that under way. There
    are none where no two ways come near each other.
    """
    found: list[Switch] = []
    rng = generator_for(scene.seed, "switches")
    for attempt in range(20 * cases):
        if len(found) == cases or len(taught) < 2:
            break
        first, second = (taught[i] for i in rng.permutation(len(taught))[:2])
        turned = _turned(scene, first, second, rng)
        if turned is None:
            continue
        row, demonstration, primitives = turned
        seen = generator_for(scene.seed, "demonstration", "switch", attempt)
        watched = watch(scene.body, demonstration, seen)
        results = recognised_while_shown(scene, learner, first.start, watched)
        steps = _noticed(scene, learner, results, row, primitives)
        found.append(Switch(first, second, row, steps, results))
    return found


def _turned(
    scene: Scene, first: PrimitiveSequence, second: PrimitiveSequence, rng: np.random.Generator
) -> tuple[int, Demonstration, list[str]] | None:
    """Return the row of a random turn, the demonstration, and the primitive shown in every row."""
    one, other = (scene.caregiver().demonstrate(sequence, rng) for sequence in (first, second))
    signs = primitives_of(second, other.begins, len(other.path))
    place = int(rng.integers(len(first.primitives)))
    stroke = np.diff([*one.begins, len(one.path)])[place]
    row = one.begins[place] + int(rng.integers(max(stroke // 4, 1), max(3 * stroke // 4, 2)))
    under_way = first.primitives[place].name
    rows = [r for r in range(len(other.path) - LEFT) if signs[r] != under_way]
    apart = np.linalg.norm(other.path[rows] - one.path[row], axis=1)
    if not (apart <= NEAR_M).any():
        return None
    goes_on = rows[int(apart.argmin())]
    turned = one.turning(row, other, goes_on, TURN)
    return row, turned, [under_way] * row + signs[goes_on:]


def primitives_of(sequence: PrimitiveSequence, begins: Sequence[int], rows: int) -> list[str]:
    """Return the primitive's name of every row of a demonstration."""
    places = np.searchsorted(begins, np.arange(rows), side="right") - 1
    return [sequence.primitives[place].name for place in places]


def _noticed(
    scene: Scene,
    learner: Learner,
    results: Sequence[OnlineResult],
    row: int,
    primitives: Sequence[str],
) -> int | None:
    learned = {each.name: each for each in learner.experiences}
    for result, primitive in zip(results[row + 1 :], primitives[row + 1 :], strict=False):
        name, place = result.learned
        if result.likeliest != NONE and _believed(scene, learned[name], place) == primitive:
            return result.row - row
    return None


def _believed(scene: Scene, learned: Experience, place: int) -> str:
    """Return the primitive that a learned motion is in, in one of its rows."""
    sequence = scene.task.sequence(learned.motion)
    return primitives_of(sequence, learned.begins, place + 1)[place]
