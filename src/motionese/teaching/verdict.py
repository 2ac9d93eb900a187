"""The verdict on a demonstration: what was seen, and whether the robot can do it.

These are two things. What was seen is what was drawn, and needs no network (see
`caregiver.hypotheses`); that the robot can do it is a claim, computed from what it has learned
(see `teaching.claim`).
"""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Literal

from motionese.caregiver import SOMETHING_ELSE
from motionese.errors import TaskError
from motionese.task import PrimitiveSequence, Task
from motionese.teaching.claim import Claim

Advice = Literal["imitate", "learn"]
SURE = 0.8


@dataclass(frozen=True)
class Verdict:
    """What the robot says of a demonstration.

    Attributes:
        seen: How likely every motion was shown, and something else, the likeliest first.
        motion: What was shown is called from now on.
        sequence: What was shown; None if that is no sequence of the task.
        error_cm: Mean distance of the understood path from the shown one, row by row [cm].
        claim: Whether it can do it.
        saw: What was seen, in words.
        wish: What is wished of who shows, in words; empty for nothing.
    """

    seen: Mapping[str, float]
    motion: str
    sequence: PrimitiveSequence | None
    error_cm: float
    claim: Claim
    saw: str
    wish: str = ""

    @property
    def sentence(self) -> str:
        """All this in words."""
        return " ".join(filter(None, (self.saw, self.wish, self.claim.sentence)))

    @property
    def line(self) -> str:
        """What of it stands in one line: a wish comes before the claim, which has its own place."""
        return f"{self.saw} {self.wish or self.claim.sentence}"

    @property
    def advice(self) -> Advice:
        """What to do now: a try of this network that failed would fail again."""
        tried = self.claim.tried
        return "learn" if tried is not None and not tried.good else "imitate"


def sequence_called(name: str, task: Task) -> PrimitiveSequence | None:
    """Return the sequence of the task that has a name, or None."""
    try:
        return task.sequence(name)
    except TaskError:
        return None


def seen_in_words(
    seen: Mapping[str, float], motion: str, task: Task, learned: Collection[str]
) -> str:
    """Return what was seen in a sentence.

    Args:
        seen: How likely every motion was shown, the likeliest first.
        motion: What was shown is called.
        task: The task.
        learned: Motions that the robot has learned.
    """
    likeliest, share = next(iter(seen.items()))
    if likeliest == SOMETHING_ELSE:
        return f"I saw something else than I know: I call it {motion}."
    sequence = sequence_called(likeliest, task)
    if sequence is None:
        return f"I saw {motion}, which I {'have learned' if motion in learned else 'saw before'}."
    return f"{'I saw' if share > SURE else 'I think I saw'}: {task.in_words(sequence)}."
