"""The claim "I can do this": what a robot expects of its imitation before it tries.

It rests on what learning has left behind, not on how well a motion can be traced: a free initial
state lets any network trace a stroke.

- Foretelling: the demonstration up to the middle of its last stroke is recognised, with steps too
  few to leave what was learned, and the rest is compared with what was then shown.
- Expectation: what the network would command goes through the forward model of the own body, which
  is learned from experiences. How far the expected hand is from the one that was shown is the error
  that is expected, and where it comes near a place, what is due there is expected to be done.
- What the last try of the motion came to, if the network is still the same.

The thresholds were chosen on robots of seeds 0 to 2, and judged on others (`benchmarks/claims.py`).
Expected errors were wrong by 0.2 cm (median), of errors of 1 to 25 cm.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation import Watched, path_error_cm
from motionese.task import PrimitiveSequence, Task, due_effects
from motionese.teaching.forward_model import ForwardModel
from motionese.teaching.recogniser import Interpretation, Recogniser
from motionese.teaching.result import WELL_CM, Result

FORETOLD_CM = 5.0
"""A rest that is foretold so well is known; a hand that stood still would be off by 7 cm."""
REACHED_CM = 2.0
"""What is due at a place is expected to be done by a hand that is expected so near."""


@dataclass(frozen=True)
class Claim:
    """What a robot expects of its imitation of a motion.

    Attributes:
        foretold_cm: Mean distance of the foretold rest from the one that was shown [cm].
        expected_cm: The imitation's expected error [cm].
        missed: Places at which it is not expected to do what is due.
        like: The learned motion whose initial state is nearest to the one found; empty for none.
        apart: How far that is, as a share of the mean distance of learned motions from their
            middle; NaN for none.
        tried: What the network's last try of the motion came to, if there was one.
    """

    foretold_cm: float
    expected_cm: float
    missed: tuple[str, ...]
    like: str
    apart: float
    tried: Result | None = None

    @property
    def made(self) -> bool:
        """Whether the robot claims that it can do the motion."""
        return not self._doubt

    @property
    def sentence(self) -> str:
        """The claim, or what speaks against it."""
        return f"I cannot do this yet: {self._doubt}." if self._doubt else "I can do this."

    @property
    def _doubt(self) -> str:
        if self.tried is not None and not self.tried.good:
            failed = [push for push in self.tried.pushes if not push.made]
            what = failed[0].sentence if failed else f"missed by {self.tried.error_cm:.1f} cm"
            return f"my last try {what}"
        if not np.isfinite(self.expected_cm):
            return "I have never moved"
        if not self.foretold_cm <= FORETOLD_CM:
            return f"it went on {self.foretold_cm:.1f} cm from what I expected"
        if not self.expected_cm <= WELL_CM:
            return f"I expect to miss by {self.expected_cm:.1f} cm"
        return f"I expect to miss {self.missed[0]}" if self.missed else ""


def claim_on(
    watched: Watched,
    sequence: PrimitiveSequence | None,
    recogniser: Recogniser,
    interpretation: Interpretation,
    tried: Result | None = None,
) -> Claim:
    """Return what a robot claims of a demonstration that it has understood.

    Args:
        watched: The demonstration.
        sequence: What it shows; None if that is no sequence of the task.
        recogniser: What recognised it.
        interpretation: What was understood of it.
        tried: What the network's last try of the motion came to, if there was one.
    """
    scene, learner, shown = recogniser.scene, recogniser.learner, watched.path
    middle = (watched.begins[-1] + len(shown)) // 2 + 1
    foretold = path_error_cm(recogniser.foretold(watched, middle)[middle:], shown[middle:])
    like, apart = _nearest(recogniser, interpretation.state)
    if not learner.experiences:
        return Claim(foretold, np.inf, (), like, apart, tried)
    hand = ForwardModel(scene, learner.experiences).hand(interpretation.commands)
    missed = _missed(hand, watched, sequence, scene.task)
    return Claim(foretold, path_error_cm(hand, shown), missed, like, apart, tried)


def _missed(
    hand: Float[ndarray, "T 3"], watched: Watched, sequence: PrimitiveSequence | None, task: Task
) -> tuple[str, ...]:
    due = due_effects(sequence, watched.begins, len(hand)) if sequence else []
    off = [
        100 * float(np.linalg.norm(hand[rows] - task.position(primitive.end), axis=1).min())
        for primitive, rows in due
    ]
    ends = [primitive.end for primitive, _ in due]
    return tuple(end for end, cm in zip(ends, off, strict=True) if cm > REACHED_CM)


def _nearest(recogniser: Recogniser, state: Float[ndarray, " N"]) -> tuple[str, float]:
    """Return the learned motion of the nearest initial state of the context, and its distance."""
    experiences, io = recogniser.learner.experiences, recogniser.learner.network.io_size
    if not experiences:
        return "", np.nan
    states = np.array([each.initial_state[io:] for each in experiences])
    apart = np.linalg.norm(states - state[io:], axis=1)
    spread = float(np.linalg.norm(states - states.mean(axis=0), axis=1).mean())
    nearest = int(apart.argmin())
    return experiences[nearest].motion, float(apart[nearest]) / spread if spread else np.nan
