"""One try at a motion that was shown: what the robot did, and how far that was off."""

from collections.abc import Mapping
from dataclasses import dataclass

from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import Performance
from motionese.teaching.result import Result


@dataclass(frozen=True)
class Trial:
    """A performance of what was shown.

    Attributes:
        performance: What the robot did.
        state: The initial state it began from. [N]
        result: What it came to.
        levels: Sizes of the network's levels, by name: whose the performance's potentials are.
    """

    performance: Performance
    state: Float[ndarray, " N"]
    result: Result
    levels: Mapping[str, int]

    @property
    def error_cm(self) -> float:
        """Mean distance from the path that was shown, row by row [cm]."""
        return self.result.error_cm
