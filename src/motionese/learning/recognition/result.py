"""What recognition found for one motion, and the verdict on it."""

from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.learning.accuracy import channel_errors, predicted
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.motions import Motions
from motionese.learning.recognition.search import Found
from motionese.learning.settings import Recognition
from motionese.learning.status import Ending, Status
from motionese.network import MTRNN


@dataclass(frozen=True)
class RecognitionResult:
    """What recognition found for one motion.

    Attributes:
        initial_state: u_0 of all levels. [N]
        path: The recognised motion in closed loop, all channels, in their units. [T, D]
        residual: Root mean squared error of every observed channel in its unit; NaN for a channel
            that was not observed. [D]
        error: The residual over the observed channels, as a share of their ranges.
        loss: Equation (3) over what was observed, and the penalty.
        start: Which start was the best, the given ones counted first.
        status: Recognised, not recognised, or diverged.
    """

    initial_state: Float[ndarray, " N"]
    path: Float[ndarray, "T D"]
    residual: Float[ndarray, " D"]
    error: float
    loss: float
    start: int
    status: Status


def judged(
    network: MTRNN,
    motions: Motions,
    batch: Batch,
    found: Found,
    settings: Recognition,
) -> list[RecognitionResult]:
    """Judge the initial states that were found, one for every motion of a batch.

    Args:
        network: The network.
        motions: The motions that were recognised.
        batch: The same motions, perhaps with empty ones after them.
        found: What the search came to.
        settings: What counts as recognised.
    """
    states, losses, chosen = (np.asarray(part) for part in found)
    paths = predicted(network, batch, states, 0.0)
    residuals = channel_errors(paths, batch, motions.channels)
    spans = motions.channels.spans
    results = []
    for i, length in enumerate(motions.lengths):
        shares = residuals[i][~np.isnan(residuals[i])] / spans[~np.isnan(residuals[i])]
        worst = float(shares.max()) if len(shares) else np.nan
        results.append(
            RecognitionResult(
                initial_state=states[i],
                path=motions.channels.from_unit(paths[i, :length]),
                residual=residuals[i],
                error=float(np.sqrt((shares**2).mean())) if len(shares) else np.nan,
                loss=float(losses[i, chosen[i]]),
                start=int(chosen[i]),
                status=_verdict(float(losses[i, chosen[i]]), worst, settings),
            )
        )
    return results


def _verdict(loss: float, worst: float, settings: Recognition) -> Status:
    if not np.isfinite(loss):
        return Status(Ending.DIVERGED, "no start kept a finite error")
    if np.isnan(worst):
        return Status(Ending.NOT_RECOGNISED, "nothing was observed after the first row")
    told = f"largest residual {worst:.1%} of a channel's range, allowed {settings.tolerance:.1%}"
    return Status(Ending.RECOGNISED if worst <= settings.tolerance else Ending.NOT_RECOGNISED, told)
