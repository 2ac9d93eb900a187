"""What changes while a model runs."""

from dataclasses import dataclass

import numpy as np
from numpy import ndarray


@dataclass
class State:
    """The state of one running motion; it belongs to one step at a time.

    Attributes:
        u: Potentials of all units. [N]
        y: Their outputs; those of the first D units are the channels' present row. [N]
    """

    u: ndarray
    y: ndarray

    def copy(self) -> "State":
        """Return a state of its own, to try a motion out from here."""
        return State(self.u.copy(), self.y.copy())


def sigmoid(u: ndarray, out: ndarray) -> ndarray:
    """Equation (2), written into `out`; by tanh, which cannot overflow as exp(−u) does."""
    np.multiply(u, 0.5, out=out)
    np.tanh(out, out=out)
    np.multiply(out, 0.5, out=out)
    np.add(out, 0.5, out=out)
    return out
