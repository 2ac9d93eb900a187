"""How a training or a recognition ended: a status with a sentence, never a silent NaN."""

from dataclasses import dataclass
from enum import Enum


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
