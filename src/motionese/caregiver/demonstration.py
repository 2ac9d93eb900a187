"""A demonstration: the path of the caregiver's hand, and the rows at which its primitives begin."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import TaskError
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


@runtime_checkable
class Caregiver(Protocol):
    """Whoever shows sequences of primitives."""

    def demonstrate(self, sequence: PrimitiveSequence, rng: np.random.Generator) -> Demonstration:
        """Show a sequence; whatever is random is drawn from `rng`."""
