"""The task as an automaton: corners, primitives between them, and every sequence they allow.

Which primitive follows which is nowhere listed: one follows another where it ends. The six pairs
and seven triples of the paper's experiment (its Table II), and which of them are taught, are
derived.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from motionese.errors import TaskError, unknown


@dataclass(frozen=True)
class Primitive:
    """A stroke of the hand from one corner to another, with the button it presses, if any."""

    name: str
    start: str
    end: str
    arrow: str
    presses: str | None = None


@dataclass(frozen=True)
class Motion:
    """Primitives performed one after the other, each beginning where the last one ended."""

    primitives: tuple[Primitive, ...]

    def __post_init__(self) -> None:
        if not self.primitives:
            raise TaskError("a motion needs at least one primitive")
        for first, second in self.pairs():
            if first.end != second.start:
                raise TaskError(
                    f"impossible sequence {'+'.join(p.name for p in self.primitives)}: "
                    f"{first.name} ends at {first.end}, {second.name} starts at {second.start}"
                )

    @property
    def name(self) -> str:
        """Start corner and arrows, such as 'UR ↓↑←'."""
        return f"{self.start} {''.join(p.arrow for p in self.primitives)}"

    @property
    def start(self) -> str:
        """The corner it starts from."""
        return self.primitives[0].start

    @property
    def corners(self) -> tuple[str, ...]:
        """The corners it passes, the first one included."""
        return (self.start, *(p.end for p in self.primitives))

    def pairs(self) -> tuple[tuple[Primitive, Primitive], ...]:
        """Every two primitives that follow each other in it."""
        return tuple(zip(self.primitives, self.primitives[1:], strict=False))


@dataclass(frozen=True)
class Task:
    """Primitives, and the pairs of them that the caregiver leaves out.

    Attributes:
        primitives: The automaton's transitions.
        untaught: Pairs of names that are possible and never taught.
    """

    primitives: tuple[Primitive, ...]
    untaught: frozenset[tuple[str, str]]

    def sequences(self, length: int) -> tuple[Motion, ...]:
        """Every motion of so many primitives that the automaton allows."""
        chains: Iterable[tuple[Primitive, ...]] = [(p,) for p in self.primitives]
        for _ in range(length - 1):
            chains = [(*c, p) for c in chains for p in self.primitives if c[-1].end == p.start]
        return tuple(Motion(chain) for chain in chains)

    def is_taught(self, motion: Motion) -> bool:
        """Whether it has no pair that the caregiver leaves out."""
        return not any((a.name, b.name) in self.untaught for a, b in motion.pairs())

    def taught_pairs(self) -> tuple[Motion, ...]:
        """The pairs that the caregiver teaches."""
        return tuple(m for m in self.sequences(2) if self.is_taught(m))

    def motion(self, text: str) -> Motion:
        """Read a motion: corner and arrows ('UR ↓↑'), or primitives ('PUSH(R)+RAISE(R)').

        Raises:
            TaskError: An unknown corner or primitive, or a sequence the automaton does not allow.
        """
        if any(p.name in text for p in self.primitives) or "+" in text:
            by_name = {p.name: p for p in self.primitives}
            names = [name.strip() for name in text.split("+")]
            for name in names:
                if name not in by_name:
                    raise TaskError(unknown("primitive", name, by_name))
            return Motion(tuple(by_name[name] for name in names))
        return Motion(tuple(self._walk(text)))

    def _walk(self, text: str) -> Iterator[Primitive]:
        corner, _, arrows = text.strip().partition(" ")
        corners = sorted({p.start for p in self.primitives})
        if corner not in corners or not arrows.strip():
            raise TaskError(
                f"'{text}' is no motion: write a start corner ({', '.join(corners)}) and arrows, "
                f"such as '{self.sequences(1)[0].name}', or primitives joined by +"
            )
        for arrow in arrows.strip():
            leaving = {p.arrow: p for p in self.primitives if p.start == corner}
            if arrow not in leaving:
                raise TaskError(
                    f"impossible sequence '{text}': "
                    f"from {corner} only {', '.join(leaving)} leads on"
                )
            yield leaving[arrow]
            corner = leaving[arrow].end


PUSHING_BUTTONS = Task(
    primitives=(
        Primitive("PUSH(R)", "UR", "LR", "↓", presses="LR"),
        Primitive("RAISE(R)", "LR", "UR", "↑"),
        Primitive("SLIDE", "UR", "UL", "←"),
        Primitive("PUSH(L)", "UL", "LL", "↓", presses="LL"),
        Primitive("RAISE(L)", "LL", "UL", "↑"),
    ),
    untaught=frozenset({("RAISE(R)", "PUSH(R)"), ("RAISE(L)", "PUSH(L)")}),
)
"""The paper's task: upper and lower, right and left corners, the lower ones being buttons."""

BUTTONS = ("LR", "LL")
"""The buttons' corners, in the order in which the body reports their depths."""
