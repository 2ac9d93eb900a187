"""How far predictions are from motions: what training and recognition make small."""

from collections.abc import Callable
from dataclasses import dataclass

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from motionese.learning.motions.batch import Batch
from motionese.network import MTRNN, Prediction


@dataclass(frozen=True)
class Error:
    """An error of predictions; `ERRORS` holds all there are.

    Attributes:
        cost: What one value costs, of its squared residual and its predicted variance.
        variance: Whether it needs a network that predicts variances.
    """

    cost: Callable[[Array, Array | None], Array]
    variance: bool

    def __call__(self, predicted: Prediction, batch: Batch) -> Float[Array, " S"]:
        """Return the error of every motion, summed by weight; row 0 predicts nothing."""
        return self.weighted((predicted.mean - batch.sensed) ** 2, predicted.variance, batch.weight)

    def weighted(
        self, squared: Array, variance: Array | None, weight: Float[Array, "S T D"]
    ) -> Float[Array, " S"]:
        """Return the error of squared residuals that broadcast to [S, T, D]."""
        return (self.cost(squared, variance) * weight)[:, 1:].sum((1, 2))


def _squared(squared: Array, variance: Array | None) -> Array:
    """Equation (3): (y − T)²."""
    return squared


def _gaussian(squared: Array, variance: Array | None) -> Array:
    """Negative log likelihood of a Gaussian of the predicted variance: ½ (y − T)²/v + ½ ln 2πv."""
    assert variance is not None, "asked of networks that predict variances alone"
    return 0.5 * (squared / variance + jnp.log(2 * np.pi * variance))


ERRORS = {
    "squared": Error(_squared, variance=False),
    "gaussian": Error(_gaussian, variance=True),
}


def error_of(network: MTRNN) -> Error:
    """Return the error that judges what a network predicts: by its variance where it has one."""
    return ERRORS["gaussian" if network.variance else "squared"]
