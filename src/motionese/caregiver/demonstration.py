"""A demonstration: the path of the caregiver's hand, and the rows at which its primitives begin."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import TaskError
from motionese.minimum_jerk import minimum_jerk
from motionese.task import PrimitiveSequence


@dataclass(frozen=True)
class Demonstration:
    """A sequence as it was shown.

    Attributes:
        path: The hand's positions [m, world], one row a control period.
        begins: The row at which each primitive begins: the hand is still at its start place.
    """

    path: Float[ndarray, "T 3"]
    begins: tuple[int, ...]

    def __post_init__(self) -> None:
        rising = all(a < b for a, b in pairwise((*self.begins, len(self.path))))
        if not self.begins or self.begins[0] != 0 or not rising:
            raise TaskError(
                f"the primitives of a demonstration of {len(self.path)} rows must begin at rising "
                f"rows from 0 on, got {', '.join(map(str, self.begins)) or 'none'}"
            )

    def turning(self, row: int, other: "Demonstration", goes_on: int, over: int) -> "Demonstration":
        """Return a demonstration that turns into another, from one minimum-jerk weight to the next.

        Args:
            row: The last row that is this one's alone.
            other: What it turns into.
            goes_on: The row of the other that takes the place of `row`.
            over: Rows until it is the other's alone.
        """
        rest = other.path[goes_on:]
        own = self.path[np.minimum(row + np.arange(len(rest)), len(self.path) - 1)]
        weight = minimum_jerk(np.minimum(np.arange(len(rest)) / over, 1.0))[:, None]
        path = np.concatenate([self.path[:row], (1 - weight) * own + weight * rest])
        begins = [b for b in self.begins if b < row]
        later = [row + b - goes_on for b in other.begins if b > goes_on]
        return Demonstration(path, (*begins, *later))


@runtime_checkable
class Caregiver(Protocol):
    """Whoever shows sequences of primitives."""

    def demonstrate(self, sequence: PrimitiveSequence, rng: np.random.Generator) -> Demonstration:
        """Show a sequence; whatever is random is drawn from `rng`."""
