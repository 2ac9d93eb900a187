"""What a lesson demands of memory: how much of the way on is open, and for how long to be kept."""

import math
from collections import Counter
from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass

from motionese.task.sequence import PrimitiveSequence


@dataclass(frozen=True)
class MemoryDemand:
    """The memory of order that a lesson demands.

    Attributes:
        corner: D_corner [bit], what is open of the way on to one who knows the place reached.
        last: D_last [bit], the same to one who also knows the primitive that led there.
        history: D_history [bit], the same to one who knows all that was done since the start:
            what remains can only have been known before it, hence be in the initial states u_0.
        hold: For how many rows since the start it must be remembered at most.
        load: Bits a transition, times the rows for which they must be remembered.
    """

    corner: float
    last: float
    history: float
    hold: int
    load: float

    @property
    def sentence(self) -> str:
        """The demand in words."""
        if self.history == 0:
            return "this lesson asks for no memory of order"
        return (
            f"the way on must be remembered for {self.hold} steps; "
            f"{self.history:.2f} bit a transition"
        )


def memory_demand(
    lesson: Iterable[PrimitiveSequence], rows: Callable[[PrimitiveSequence], int]
) -> MemoryDemand:
    """Return what a lesson demands of memory.

    Its transitions are all primitives but the first one of every sequence; each counts equally,
    n in all. With h the history of a transition (the start place and all primitives before it)
    and c what is known of h, the conditional entropy of the next primitive is
    H(next | c) = −Σ_next p(next | c) log2 p(next | c), p being shares of transitions with this c.

    - D_c = (1/n) Σ H(next | c) over the transitions, for c the place reached (D_corner), place
      and last primitive (D_last), and h itself (D_history); 0 ≤ D_history ≤ D_last ≤ D_corner;
    - hold = the greatest rows(h) over the transitions with H(next | h) > 0, or 0;
    - load = (1/n) Σ H(next | h) rows(h) over the transitions [bit · rows].

    Where a sequence ends is no transition. A lesson of primitives alone has none, and demands
    nothing.

    Args:
        lesson: Its sequences; one that is there twice counts twice.
        rows: How many rows after the start of a sequence another primitive begins, such as a
            caregiver's `Manner.rows_until_next`.
    """
    transitions = [
        (PrimitiveSequence(sequence.primitives[:at]), following)
        for sequence in lesson
        for at, following in enumerate(sequence.primitives)
        if at
    ]

    def surprises(known: Callable[[PrimitiveSequence], Hashable]) -> list[float]:
        """Return −log2 p(next | known) of every transition; H(next | known) is their mean."""
        contexts = Counter(known(history) for history, _ in transitions)
        ways = Counter((known(history), following) for history, following in transitions)
        return [math.log2(contexts[known(h)] / ways[known(h), f]) for h, f in transitions]

    remembered = surprises(lambda history: history)
    held = [rows(history) for history, _ in transitions]
    return MemoryDemand(
        corner=_mean(surprises(lambda history: history.places[-1])),
        last=_mean(surprises(lambda history: history.primitives[-1])),
        history=_mean(remembered),
        hold=max((h for h, bits in zip(held, remembered, strict=True) if bits > 0), default=0),
        load=_mean([h * bits for h, bits in zip(held, remembered, strict=True)]),
    )


def _mean(values: list[float]) -> float:
    return math.fsum(values) / max(len(values), 1)
