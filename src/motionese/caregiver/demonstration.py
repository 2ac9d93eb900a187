"""A demonstration: the path of the caregiver's hand, and the rows at which its primitives begin."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import TaskError, unknown
from motionese.task import PrimitiveSequence


@dataclass(frozen=True)
class Demonstration:
    """A sequence as it was shown.

    Attributes:
        path: The hand's positions [m, world], one row a control period. [T, 3]
        begins: The row at which each primitive begins: the hand is still at its start place.
    """

    path: Float[ndarray, "T 3"]
    begins: tuple[int, ...]

    def __post_init__(self) -> None:
        rising = all(
            a < b for a, b in zip(self.begins, (*self.begins[1:], len(self.path)), strict=True)
        )
        if not self.begins or self.begins[0] != 0 or not rising:
            raise TaskError(
                f"the primitives of a demonstration of {len(self.path)} rows must begin at rising "
                f"rows from 0 on, got {', '.join(map(str, self.begins)) or 'none'}"
            )


@runtime_checkable
class Caregiver(Protocol):
    """Whoever shows sequences of primitives."""

    def demonstrate(self, sequence: PrimitiveSequence, rng: np.random.Generator) -> Demonstration:
        """Show a sequence; whatever is random is drawn from `rng`."""
        ...


class RecordedCaregiver:
    """Recorded demonstrations in the place of the scripted caregiver."""

    def __init__(
        self, recordings: Mapping[str, list[Demonstration]], otherwise: Caregiver | None = None
    ) -> None:
        """Take demonstrations by the sequence's name, at the body's rate.

        Args:
            recordings: The demonstrations.
            otherwise: Who shows what was not recorded.
        """
        self.recordings, self.otherwise = dict(recordings), otherwise

    def demonstrate(self, sequence: PrimitiveSequence, rng: np.random.Generator) -> Demonstration:
        """Return one of the sequence's recordings; `TaskError` if nobody can show it."""
        recorded = self.recordings.get(sequence.name)
        if not recorded and self.otherwise is not None:
            return self.otherwise.demonstrate(sequence, rng)
        if not recorded:
            raise TaskError(unknown("recorded sequence", sequence.name, self.recordings))
        return recorded[int(rng.integers(len(recorded)))]


def rows_of_places(path: Float[ndarray, "T 3"], places: Float[ndarray, "K 3"]) -> tuple[int, ...]:
    """Return the rows at which a path comes by places in turn, the first of them at row 0.

    The rows rise, and the sum of the distances [m] there is the least possible (by dynamic
    programming): every place is passed where the path is nearest to it, in the order given.
    """
    apart = np.linalg.norm(path[None] - places[:, None], axis=-1)
    rows, count = len(path), len(places)
    cost = np.full((count, rows), np.inf)
    origin = np.zeros((count, rows), dtype=np.int64)
    cost[0, 0] = apart[0, 0]
    for place in range(1, count):
        best, at = np.inf, 0
        for row in range(1, rows):
            if cost[place - 1, row - 1] < best:
                best, at = cost[place - 1, row - 1], row - 1
            cost[place, row], origin[place, row] = best + apart[place, row], at
    passed = [int(cost[-1].argmin())]
    for place in range(count - 1, 0, -1):
        passed.append(int(origin[place, passed[-1]]))
    return tuple(reversed(passed))
