"""Places, primitives between them, and sequences of primitives: symbols, not data."""

from dataclasses import dataclass
from itertools import pairwise

from motionese.errors import TaskError
from motionese.task.way import Way, straight


@dataclass(frozen=True)
class Place:
    """A position of the hand that has a name.

    Attributes:
        name: Its name, such as 'UR'.
        position: Where the hand is [m, world].
        title: The place in words, such as 'the upper right'.
    """

    name: str
    position: tuple[float, float, float]
    title: str


@dataclass(frozen=True)
class Primitive:
    """A stroke of the hand from one place to another.

    Attributes:
        name: Its name, such as 'PUSH(R)'.
        sign: One character that tells it from the others that leave the same place.
        start: Name of the place it leaves.
        end: Name of the place it leads to.
        words: The stroke in words, such as 'down'.
        way: How the hand gets there.
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
    (start_one, _, signs_one), (start_other, _, signs_other) = (
        name.partition(" ") for name in (one, other)
    )
    if start_one != start_other:
        return 0
    same = [a == b for a, b in zip(signs_one, signs_other, strict=False)]
    return 1 + (same.index(False) if False in same else len(same))
