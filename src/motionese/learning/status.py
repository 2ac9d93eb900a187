"""How far a training is, and how it or a recognition ended: a status, never a silent NaN."""

from dataclasses import dataclass
from enum import Enum
from typing import NamedTuple


class Ending(Enum):
    """The ways in which an optimisation can end."""

    CONVERGED = "converged"
    STOPPED = "stopped"
    DIVERGED = "diverged"
    RECOGNISED = "recognised"
    NOT_RECOGNISED = "not recognised"


@dataclass(frozen=True)
class Status:
    """An ending and the sentence that explains it, for logs and reports."""

    ending: Ending
    sentence: str

    @property
    def failed(self) -> bool:
        """Whether the result must not be used."""
        return self.ending is Ending.DIVERGED

    def __str__(self) -> str:
        return f"{self.ending.value}: {self.sentence}"


class Progress(NamedTuple):
    """How far a training is.

    Attributes:
        epoch: Epochs done.
        loss: Equation (3) before the last update.
        closed_loop_error: Root mean squared error in closed loop, as a share of range.
        validation_loss: Of the held-out motions, as `validation_error` is; None without any.
    """

    epoch: int
    loss: float
    closed_loop_error: float
    validation_loss: float | None
    validation_error: float | None
