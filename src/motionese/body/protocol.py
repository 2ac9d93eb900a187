"""What the imitation loop needs of a body, simulated or real."""

from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.channels import Channels


@runtime_checkable
class Body(Protocol):
    """A robot with an arm of two commanded angles, an eye that follows a hand, and a clock.

    Time passes in `step` only: a real robot waits there for the end of its control period.
    """

    channels: Channels
    """What `sense` returns, in order; the first two are the commanded joints of the arm."""
    rate_hz: float
    """Control periods a second."""

    def reset(self, posture: Float[ndarray, "2"], rng: np.random.Generator) -> None:
        """Begin a trial: arm settled at the commanded angles [rad], eye on its own hand.

        Whatever is random until the next call (sensor noise) is drawn from `rng`.
        """
        ...

    def sense(self) -> Float[ndarray, "6"]:
        """Return the channels' values now, in the channels' units."""
        ...

    def command(self, arm: Float[ndarray, "2"]) -> None:
        """Command arm angles [rad], in force from now on; clamped to what may be commanded."""
        ...

    def step(self) -> None:
        """Let one control period, 1/`rate_hz`, pass."""
        ...
