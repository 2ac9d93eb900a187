"""Why a trained network is no better, as far as its numbers tell: measures, and what follows.

| what the numbers show | measure | advice |
|---|---|---|
| what follows is not told by what came before | `forks` ≥ `MANY_FORKS` | other recordings |
| the rows themselves scatter as much | `noise` · `AS_NOISE` ≥ `closed` | smoother recordings |
| the closed loop drifts from what is predicted | `forced` < `DRIFT` · `closed` | less forcing |
| the loss still falls | `left` ≤ `FALLS` | more epochs |
| the loss has levelled off | `left` ≥ `LEVEL`, from `SOONEST` epochs on | more units |

The first line that holds is told, if errors in closed loop are above `GOOD`; where none does, that
the numbers do not tell. That held-out motions are worse than learned ones is told beside it.
"""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.learning.fit import Fit
from motionese.learning.motions.motions import Motions
from motionese.learning.predictability import forks, row_noise

GOOD, POOR = 0.03, 0.1
"""Closed-loop errors, as shares of range, up to which a model is good and from which it is poor."""
MANY_FORKS = 2.25
"""Forks of a motion from which on it is not its initial states that are to tell its way: one is
what they are for, two are an order of three parts that is to be remembered."""
AS_NOISE = 1.25
"""Errors up to so many times the noise of the rows are those of the rows."""
DRIFT = 0.4
"""Below this share of the closed loop's error the teacher-forced one is another matter."""
LITTLE_FORCING = 0.1
"""Teacher forcing up to which the closed loop itself is trained."""
FALLS, LEVEL = 0.75, 0.85
"""Shares of the error that would be left after as many epochs again: with less the loss still
falls, with more it has levelled off."""
WORSE = 2.0
"""Held-out motions are worse if their error is so many times that of learned ones."""
FEWEST, SOONEST = 40, 300
"""Epochs from which on a loss has a course, and before which one that lies still may fall later."""


@dataclass(frozen=True)
class Diagnosis:
    """What the numbers of a training show.

    Attributes:
        forced: Teacher-forced error, as a share of range.
        closed: Error in closed loop, as a share of range.
        unseen: The same of held-out motions; NaN without any.
        noise: What scatters from row to row, as a share of range; see `row_noise`.
        forks: How often a motion goes on otherwise than another from the same state; see `forks`.
        left: Share of the error that as many epochs again would leave, see `error_left`.
        forcing: Share of teacher forcing in training.
        epochs: Of this training.
    """

    forced: float
    closed: float
    unseen: float
    noise: float
    forks: float
    left: float
    forcing: float
    epochs: int

    def sentences(self, before: int = 0) -> list[str]:
        """Return what the numbers show in words, and what would help; nothing of a good model.

        Args:
            before: Epochs that the network has had before this training.
        """
        told = []
        if self.closed > POOR:
            told.append("On a robot these motions would not be recognisable.")
        elif self.closed > GOOD:
            told.append(f"Closed-loop errors above {GOOD:.0%} can be seen.")
        worse = self.unseen > max(WORSE * self.closed, GOOD)
        if self.closed > GOOD or (worse and self.forks >= MANY_FORKS):
            told.append(self._why(before + 2 * self.epochs))
        if worse and self.forks < MANY_FORKS:
            told.append(
                f"Held-out motions are {self.unseen / self.closed:.1f} times as far off as learned "
                "ones: more motions would help, or fewer units."
            )
        return told

    def _why(self, more: int) -> str:
        """Return the first line of the table that holds; `more` epochs would be as many again."""
        again = f"--epochs {more} --resume"
        gain = f"as many epochs again would leave about {min(self.left, 1):.0%} of the error"
        if self.forks >= MANY_FORKS:
            return (
                f"From the same state motions go on differently, {self.forks:.1f} times in each: "
                "what follows is chance, or told by what lies far back. Longer training, or more "
                "units, learn such motions by heart at best, and no others; a channel that tells "
                "what comes next would help, or motions that fork less."
            )
        if self.closed <= AS_NOISE * self.noise:
            return (
                f"The rows themselves scatter by {self.noise:.1%} from one to the next: no "
                "training comes nearer; smooth the recordings."
            )
        if self.forced < DRIFT * self.closed and self.forcing > LITTLE_FORCING:
            return (
                "The next row is predicted well, the closed loop drifts from it: train with less "
                f"teacher forcing, --set teacher_forcing=0.05 (it was {self.forcing:g})."
            )
        if self.left <= FALLS:
            return f"The loss still falls, {gain}: train longer, {again}."
        if self.left >= LEVEL and self.epochs >= SOONEST:
            return f"The loss has levelled off, {gain}: more units would help, with --levels."
        return (
            f"The numbers do not tell why: train longer ({again}), or with more units (--levels)."
        )


def diagnose(fit: Fit, motions: Motions, forcing: float) -> Diagnosis:
    """Return what the numbers of a training show.

    Args:
        fit: What it left, its losses those of one schedule.
        motions: What was learned.
        forcing: Share of teacher forcing.
    """
    return Diagnosis(
        forced=fit.share(fit.teacher_forced_error),
        closed=fit.share(fit.closed_loop_error),
        unseen=fit.share(fit.validation_error),
        noise=row_noise(motions),
        forks=forks(motions),
        left=error_left(fit.losses),
        forcing=forcing,
        epochs=len(fit.losses),
    )


def error_left(losses: Float[ndarray, " E"]) -> float:
    """Return which share of the error would be left after as many epochs again.

    The loss is taken to go on falling by the power of the epochs that fits its second half best,
    E ~ e^s (least squares of log E over log e, so that single leaps count little), and the error
    goes with the loss's root: 2^(s/2). NaN of fewer than `FEWEST` epochs.
    """
    epochs = np.arange(len(losses) // 2, len(losses))
    if len(losses) < FEWEST or not (np.isfinite(losses).all() and losses[epochs].min() > 0):
        return float("nan")
    slope = np.polyfit(np.log(epochs + 1), np.log(losses[epochs]), 1)[0]
    return float(2 ** (slope / 2))
