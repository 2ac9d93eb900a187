"""One try at a motion that was shown: what the robot did, and how far that was off."""

from collections.abc import Mapping
from dataclasses import dataclass

from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import Performance


@dataclass(frozen=True)
class Trial:
    """A performance of what was shown.

    Attributes:
        performance: What the robot did.
        state: The initial state it began from. [N]
        error_cm: Mean distance from the path that was shown, row by row [cm].
        levels: Sizes of the network's levels, by name: whose the performance's potentials are.
    """

    performance: Performance
    state: Float[ndarray, " N"]
    error_cm: float
    levels: Mapping[str, int]
