"""Held-out motions: recognised again and again while a network is trained without them."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.learning.motions import Motions
from motionese.learning.recognise import recognise_all
from motionese.learning.settings import Recognition
from motionese.network import MTRNN

WARM = Recognition(iterations=50, starts=0, rate=0.1)
"""They are recognised from where the last recognition ended, so a few updates do."""


def look_again(
    network: MTRNN, motions: Motions, states: Float[ndarray, "H N"]
) -> tuple[Float[ndarray, "H N"], float]:
    """Recognise held-out motions once more, the weights frozen.

    Args:
        network: The network as trained so far.
        motions: The held-out motions.
        states: Their initial states as found the last time.

    Returns:
        The initial states found now, and the summed loss (3).
    """
    found = recognise_all(network, motions, starts=states[:, None], settings=WARM)
    return np.stack([f.initial_state for f in found]), sum(f.loss for f in found)
