"""Places, primitives between them, and sequences of primitives: symbols, not data."""

from dataclasses import dataclass
from itertools import pairwise

from motionese.errors import TaskError
from motionese.task.way import Way, straight


@dataclass(frozen=True)
class Place:
    """A `position` of the hand [m, world].

    Attributes:
        name: What it is called everywhere, such as 'UR'.
        title: What the name stands for, such as 'the upper right'; said where it is explained.
    """

    name: str
    position: tuple[float, float, float]
    title: str


@dataclass(frozen=True)
class Primitive:
    """A stroke of the hand from one place to another.

    Attributes:
        name: Such as 'PUSH(R)'.
        sign: One character that tells it from the others that leave the same place.
        words: The stroke in words, such as 'down'.
        duration: How many times as long as a stroke it takes.
        effect: What it has to bring about, as the body names it; empty where nothing.
    """

    name: str
    sign: str
    start: str
    end: str
    words: str
    way: Way = straight
    duration: float = 1.0
    effect: str = ""


@dataclass(frozen=True)
class PrimitiveSequence:
    """Primitives one after the other, each beginning where the last one ended."""

    primitives: tuple[Primitive, ...]

    def __post_init__(self) -> None:
        if not self.primitives:
            raise TaskError("a sequence needs at least one primitive")
        for first, second in self.pairs():
            if first.end != second.start:
                raise TaskError(
                    f"impossible sequence {'+'.join(p.name for p in self.primitives)}: "
                    f"{first.name} ends at {first.end}, {second.name} starts at {second.start}"
                )

    @property
    def name(self) -> str:
        """Start place and signs, such as 'UR ↓↑←'."""
        return f"{self.start} {''.join(p.sign for p in self.primitives)}"

    @property
    def start(self) -> str:
        """The place it starts from."""
        return self.primitives[0].start

    @property
    def places(self) -> tuple[str, ...]:
        """The places it passes, the first one included."""
        return (self.start, *(p.end for p in self.primitives))

    def pairs(self) -> tuple[tuple[Primitive, Primitive], ...]:
        """Every two primitives that follow each other in it."""
        return tuple(pairwise(self.primitives))


def common_beginning(one: str, other: str) -> int:
    """Return how much two sequences' names have in common: the start place, then primitives."""
    (start, _, signs), (other_start, _, other_signs) = one.partition(" "), other.partition(" ")
    same = [start == other_start, *(a == b for a, b in zip(signs, other_signs, strict=False))]
    return same.index(False) if False in same else len(same)
