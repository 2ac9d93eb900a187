"""How a control loop ended, and what it did until then."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum


class Ending(StrEnum):
    """The ways in which a control loop ends."""

    DONE = "done"
    STOPPED = "stopped"
    SENSORS_SILENT = "sensors silent"
    HUNG = "hung"
    NOT_FINITE = "not finite"


SENTENCES = {
    Ending.DONE: "everything was played to its end, {steps} steps",
    Ending.STOPPED: "the loop was asked to end, after {steps} steps",
    Ending.SENSORS_SILENT: "no reading came for more than {patience:g} s; "
    "the last command sent is that of step {steps}",
    Ending.HUNG: "sense or act did not return for more than {patience:g} s; "
    "the last command sent is that of step {steps}",
    Ending.NOT_FINITE: "the prediction after step {steps} is not finite; it was not sent",
}


@dataclass(frozen=True)
class LoopReport:
    """What a control loop did.

    Attributes:
        steps: Commands sent.
        missed: Cycles whose command was sent later than the end of their period.
        skipped: Periods that had no cycle, since the one before them took too long.
        worst_lateness_s: The longest time from a period's beginning until its command was sent [s].
        clamped: How often every channel's range took hold.
        slowed: How often every channel's speed limit took hold.
        ending: How it ended.
        sentence: The same for a person.
    """

    steps: int
    missed: int
    skipped: int
    worst_lateness_s: float
    clamped: Mapping[str, int]
    slowed: Mapping[str, int]
    ending: Ending
    sentence: str
