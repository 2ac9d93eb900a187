"""What changes while a model runs."""

from dataclasses import dataclass

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
