"""Which primitives are clear yet: the experiment's question, asked of a robot that is being taught.

Three things are measured, each as in the experiment but for what is said here.

- Direction over the map of slow initial states: from which share of them a primitive goes its own
  way, with the fast state that the robot recalls (see `InteractiveMap`). The experiment seeks that
  state instead, and then newborns with a slow level go the right way from 0.3 to all of the map.
- Exchange (`imitation.roles.exchange`): whose stroke is it when two motions exchange the states of
  the highest level? Of motions that were learned, shown afresh; their states are found in few steps
  from learned ones.
- Order read out (`imitation.roles.decoders`): which way a motion goes on, told by a linear decoder
  from a level's activity in the row in which the ways part.

What is not defined for a robot is not measured, and the reason is told.
"""

from collections.abc import Generator, Iterator
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from motionese.imitation import Learner, Scene, Watched, newborn
from motionese.imitation.loop import Row
from motionese.imitation.roles import (
    RecognisedDemonstration,
    RecognisedLesson,
    decoded,
    exchanged,
)
from motionese.task import PrimitiveSequence, Task
from motionese.teaching.drawing import most_rows
from motionese.teaching.interactive_map import InteractiveMap
from motionese.teaching.recogniser import Recogniser
from motionese.teaching.verdict import sequence_called

CLEAR = 0.9
"""A primitive is clear that goes its way from so large a share of the map."""


@dataclass(frozen=True)
class Direction:
    """How clear a primitive is.

    Attributes:
        primitive: Its name, as a sequence.
        share: The share of the slow states from which it goes its own way; of the single recalled
            state where no slow level is open.
        newborn: The same of the robot as it was drawn, with as many levels.
        learned: Whether it is part of anything that was learned; else its way is chance.
    """

    primitive: str
    share: float
    newborn: float
    learned: bool

    @property
    def clear(self) -> bool:
        """Whether it goes its way, and was learned."""
        return self.learned and self.share >= CLEAR

    def sentence(self, slow: bool) -> str:
        """Return it in words; `slow` is whether a slow level is open."""
        share = f"{100 * self.share:.0f} % of the map goes that way"
        if not slow:
            share = "goes that way" if self.share else "goes another way"
        if not self.learned:
            return f"not learned yet ({share}, by chance)"
        return f"{'clear' if self.clear else 'not yet'}: {share}"


@dataclass(frozen=True)
class Following:
    """Whose strokes follow in exchanges: the lower levels' motion, the highest one's, or neither.

    `missing` says why none could be tried; empty where some were.
    """

    lower: int = 0
    upper: int = 0
    neither: int = 0
    missing: str = ""


@dataclass(frozen=True)
class Reading:
    """In which share of demonstrations a level tells the way on, and what guessing would reach."""

    level: str
    score: float
    chance: float


@dataclass(frozen=True)
class Emergence:
    """What has emerged in a network.

    Attributes:
        learner: The learner's number.
        levels: The names of its levels, from IO upwards.
        directions: Of every primitive of the task.
        first: Whose first stroke follows where two motions from one place begin differently.
        order: Whose stroke follows where two motions begin alike and go on differently.
        read: How well the order is read out of each context level; empty where there is none.
    """

    learner: int
    levels: tuple[str, ...]
    directions: tuple[Direction, ...]
    first: Following
    order: Following
    read: tuple[Reading, ...] = ()

    @property
    def slow(self) -> bool:
        """Whether a slow level is open."""
        return len(self.levels) > 2

    @property
    def sentence(self) -> str:
        """How many primitives are clear, in words."""
        clear, of = sum(each.clear for each in self.directions), len(self.directions)
        if not self.slow:
            return (
                f"{clear} of {of} strokes are learned and go their way. Whether they are clear is "
                "asked once there is a slow level that could turn them."
            )
        return (
            f"{clear} of {of} strokes are clear: learned, and from {100 * CLEAR:.0f} % of the slow "
            "states or more they go their way."
        )


def emergence_of(
    scene: Scene, learner: Learner, number: int, recogniser: Recogniser
) -> Generator[None, None, Emergence]:
    """Measure what has emerged; yields between parts that take some hundredths of a second.

    Args:
        scene: Robot and caregiver.
        learner: What the robot has become.
        number: The learner's number.
        recogniser: Recognises with it.
    """
    drawn = InteractiveMap(scene, learner)
    yield
    before = InteractiveMap(scene, newborn(scene, len(learner.network.levels)))
    yield
    sequences = _learned(learner, scene.task)
    practised = {p.name for sequence in sequences for p in sequence.primitives}
    directions = tuple(
        Direction(
            primitive.name,
            drawn.share(primitive.name),
            before.share(primitive.name),
            primitive.primitives[0].name in practised,
        )
        for primitive in scene.task.sequences(1)
    )
    levels = learner.network.names
    several = [s for s in sequences if len(s.primitives) > 1]
    missing = missing_of(several, scene.task, slow=drawn.plane.slow)
    if all(missing):
        first, order = (Following(missing=why) for why in missing)
        return Emergence(number, levels, directions, first, order)
    lesson = yield from _recognised(scene, recogniser, several, drawn)
    rows = [row for row in exchanged(lesson) if row["split"] == levels[-2]]
    yield
    first, order = (
        following_of(rows, kind, why) for kind, why in zip(("first", "order"), missing, strict=True)
    )
    return Emergence(number, levels, directions, first, order, tuple(_read(lesson)))


def _learned(learner: Learner, task: Task) -> list[PrimitiveSequence]:
    """Return the sequences of the task that a robot has learned."""
    named = (sequence_called(e.motion, task) for e in learner.experiences)
    return list(dict.fromkeys(sequence for sequence in named if sequence))


def missing_of(learned: list[PrimitiveSequence], task: Task, *, slow: bool) -> tuple[str, str]:
    """Return why first strokes and why orders cannot be exchanged; empty where they can."""
    if not slow:
        return ("There is no slow level yet to exchange.",) * 2
    parted = [_parts(pair) for pair in combinations(learned, 2)]
    possible = {_parts(pair): pair for pair in combinations(reversed(task.sequences(2)), 2)}

    def asked(wanted: bool, words: str, stroke: int) -> str:
        if wanted:
            return ""
        if stroke not in possible:
            return f"No two sequences of this task {words}."
        one, other = (s.name for s in reversed(possible[stroke]))
        return f"Teach it two sequences that {words}, such as {one} and {other}."

    return (
        asked(0 in parted, "start in one place and begin differently", 0),
        asked(any(parted), "begin alike and go on differently", 1),
    )


def _parts(pair: tuple[PrimitiveSequence, PrimitiveSequence]) -> int | None:
    """Return in which stroke, from 0, two sequences from one place part; None if they never do."""
    one, other = pair
    if one.start != other.start:
        return None
    strokes = enumerate(zip(one.primitives, other.primitives, strict=False))
    return next((i for i, (own, others) in strokes if own != others), None)


def _recognised(
    scene: Scene, recogniser: Recogniser, lesson: list[PrimitiveSequence], drawn: InteractiveMap
) -> Generator[None, None, RecognisedLesson]:
    """Show the motions of a lesson afresh, and let them be recognised one by one."""
    found, bearing, manner = [], scene.body.bearing, scene.manner
    for number in range(1, scene.settings.evaluation.roles.demonstrations + 1):
        for sequence in lesson:
            if manner.rows(sequence) > most_rows(manner):
                continue
            watched = scene.show(sequence, "emergence", number)
            found.append(_demonstration(scene, recogniser, sequence, number, watched))
            yield
    true = {s.primitives[0]: float(drawn.true[s.name][0]) for s in scene.task.sequences(1)}
    return RecognisedLesson(recogniser.learner.network, bearing, tuple(found), true)


def _demonstration(
    scene: Scene,
    recogniser: Recogniser,
    sequence: PrimitiveSequence,
    number: int,
    watched: Watched,
) -> RecognisedDemonstration:
    return RecognisedDemonstration(
        sequence,
        number,
        recogniser.recalled(watched),
        scene.as_own(sequence.start, watched)[0],
        watched.begins,
        scene.body.bearing(watched.sensed),
    )


def following_of(rows: list[Row], kind: str, missing: str) -> Following:
    """Return whose strokes followed in the exchanges of a kind."""
    told = [row["follows"] for row in rows if row["kind"] == kind]
    if missing or not told:
        return Following(missing=missing or "None of its motions could be recognised.")
    return Following(told.count("lower"), told.count("upper"), told.count("neither"))


def _read(lesson: RecognisedLesson) -> Iterator[Reading]:
    """Yield for every context level how well the order is read out where the ways part."""
    rows = [row for row in decoded(lesson) if row["what"] == "order" and row["row"] == 0]
    for level in dict.fromkeys(row["level"] for row in rows):
        own = [(row["score"], row["chance"]) for row in rows if row["level"] == level]
        score, chance = np.mean(own, axis=0)
        yield Reading(level, float(score), float(chance))
