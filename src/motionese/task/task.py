"""A task as an automaton: places, primitives between them, and every sequence they allow.

Which primitive follows which is nowhere listed: one follows another where it ends. What is taught
(lessons), what is new afterwards, and what counts as success belong to the task as well, so that
caregiver, robot, experiment and report take any task.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import TaskError, unknown
from motionese.task.sequence import Place, Primitive, PrimitiveSequence


@dataclass(frozen=True)
class Attempt:
    """An imitation, as a measure of success looks at it.

    Attributes:
        begins: The rows at which the primitives begin in what was shown.
        shown: Positions of the shown hand [m, world].
        path: Positions of the own hand [m, world].
        effects: What the task's things told, by the effect's name, such as a button's depth [mm].
    """

    begins: tuple[int, ...]
    shown: Float[ndarray, "T 3"]
    path: Float[ndarray, "T 3"]
    effects: Mapping[str, Float[ndarray, " T"]]


@dataclass(frozen=True)
class Outcome:
    """A column of success, for tables and figures.

    Attributes:
        title: What the column says, such as 'due presses that were made'.
        unit: Its unit; empty for a count.
        of: The column it is a share of; empty where it stands alone.
    """

    column: str
    title: str
    unit: str = ""
    of: str = ""


Achieved = Callable[[PrimitiveSequence, Attempt], dict[str, Any]]
"""What an attempt at a sequence has achieved, by column."""


@dataclass(frozen=True, eq=False)
class Task:
    """What is to be learned, and how success is measured.

    Attributes:
        name: The task's name in settings.
        title: The task in words.
        outcomes: The columns that `achieved` measures, the main one first.
        untaught: Pairs of primitives' names that are possible and left out of the first lesson.
        lessons: What may be taught, by name, as sequences' names; 'primitives' is always there.
        novel: Sequences that are imitated after the last loop, by the name of their table.
        fixtures: MuJoCo XML of the task's things (`<mujoco>` with what is attached to the world).
        effects: Names of what the things tell, each a slide joint of the fixtures.
        needed_mm: How deep a thing must be pushed down to count [mm].
    """

    name: str
    title: str
    places: Mapping[str, Place]
    primitives: tuple[Primitive, ...]
    achieved: Achieved
    outcomes: tuple[Outcome, ...]
    untaught: frozenset[tuple[str, str]] = frozenset()
    lessons: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    novel: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    fixtures: str = ""
    effects: tuple[str, ...] = ()
    needed_mm: float = 0.0

    def __post_init__(self) -> None:
        for primitive in self.primitives:
            for place in (primitive.start, primitive.end):
                if place not in self.places:
                    raise TaskError(
                        f"primitive {primitive.name} of {self.name}: "
                        f"{unknown('place', place, self.places)}"
                    )
        for name in (*self.lessons, *self.novel):
            self.lesson(name)

    def position(self, place: str) -> Float[ndarray, "3"]:
        """Return where the hand is at a place [m, world]."""
        if place not in self.places:
            raise TaskError(unknown("place", place, self.places))
        return np.array(self.places[place].position)

    def with_places(self, positions: Mapping[str, tuple[float, float, float]]) -> "Task":
        """Return the task with some places elsewhere [m, world]."""
        moved = dict(self.places)
        for name, position in positions.items():
            if name not in moved:
                raise TaskError(unknown("place", name, moved))
            moved[name] = replace(moved[name], position=position)
        return replace(self, places=moved) if positions else self

    def sequences(self, length: int) -> tuple[PrimitiveSequence, ...]:
        """Every sequence of so many primitives that the automaton allows."""
        chains: Iterable[tuple[Primitive, ...]] = [(p,) for p in self.primitives]
        for _ in range(length - 1):
            chains = [(*c, p) for c in chains for p in self.primitives if c[-1].end == p.start]
        return tuple(PrimitiveSequence(chain) for chain in chains)

    def is_taught(self, sequence: PrimitiveSequence) -> bool:
        """Whether it has no pair that the first lesson leaves out."""
        return not any((a.name, b.name) in self.untaught for a, b in sequence.pairs())

    def lesson(self, named: str | Iterable[str]) -> tuple[PrimitiveSequence, ...]:
        """Return the sequences of a lesson, of a set of new sequences, or one or several named.

        Raises:
            TaskError: A lesson or sequence that the task does not have.
        """
        if named == "primitives":
            return self.sequences(1)
        known = {**self.lessons, **self.novel}
        listed = known.get(named, (named,)) if isinstance(named, str) else named
        return tuple(dict.fromkeys(self.sequence(text) for text in listed))

    def lesson_name(self, lesson: Iterable[PrimitiveSequence]) -> str:
        """Return what the lesson of these sequences is called; empty where it has no name."""
        sequences, names = set(lesson), ("primitives", *self.lessons)
        return next((name for name in names if set(self.lesson(name)) == sequences), "")

    def sequence(self, text: str) -> PrimitiveSequence:
        """Read a sequence: place and signs ('UR ↓↑'), or primitives ('PUSH(R)+RAISE(R)').

        Raises:
            TaskError: An unknown place or primitive, or a sequence the automaton does not allow.
        """
        by_name = {p.name: p for p in self.primitives}
        if "+" in text or any(name in text for name in by_name):
            names = [name.strip() for name in text.split("+")]
            for name in names:
                if name not in by_name:
                    raise TaskError(unknown("primitive", name, by_name))
            return PrimitiveSequence(tuple(by_name[name] for name in names))
        return PrimitiveSequence(tuple(self._walk(text)))

    def through(self, places: Iterable[str]) -> PrimitiveSequence | None:
        """Return the sequence that passes these places, or None where there is none."""
        strokes = {(p.start, p.end): p for p in self.primitives}
        passed = [strokes.get(pair) for pair in pairwise(places)]
        whole = tuple(primitive for primitive in passed if primitive is not None)
        return PrimitiveSequence(whole) if whole and len(whole) == len(passed) else None

    def in_words(self, sequence: PrimitiveSequence) -> str:
        """Return a sequence in words, such as 'from UR down, then to the left'."""
        strokes = ", then ".join(primitive.words for primitive in sequence.primitives)
        return f"from {sequence.start} {strokes}"

    def _walk(self, text: str) -> Iterator[Primitive]:
        place, _, signs = text.strip().partition(" ")
        starts = sorted({p.start for p in self.primitives})
        if place not in starts or not signs.strip():
            lessons = ", ".join(("primitives", *self.lessons))
            raise TaskError(
                f"'{text}' is no lesson or sequence of {self.name}: write a lesson ({lessons}), a "
                f"start place ({', '.join(starts)}) and signs, such as "
                f"'{self.sequences(1)[0].name}', or primitives joined by +"
            )
        for sign in signs.strip():
            leaving = {p.sign: p for p in self.primitives if p.start == place}
            if sign not in leaving:
                raise TaskError(
                    f"impossible sequence '{text}': from {place} only {', '.join(leaving)} leads on"
                )
            yield leaving[sign]
            place = leaving[sign].end
