"""What a network predicts: the mean of every channel and, where it is drawn so, its variance."""

from typing import NamedTuple

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float

from motionese.network.mtrnn import MTRNN
from motionese.network.rollout import rollout

LEAST_VARIANCE = 1e-5
"""Added to every predicted variance, so that what a network predicts exactly has a finite weight:
a standard deviation of 0.3 % of the unit interval."""


class Prediction(NamedTuple):
    """A network's prediction of every row from the rows before it.

    Attributes:
        mean: y of the IO units, in the unit interval. [..., D]
        variance: Of every channel, in the unit interval squared; None where the network predicts
            none. [..., D]
        potentials: u of all units. [..., N]
    """

    mean: Float[Array, "*rows D"]
    variance: Float[Array, "*rows D"] | None
    potentials: Float[Array, "*rows N"]


def predict(
    network: MTRNN,
    initial: Float[Array, "B N"],
    sensed: Float[Array, "B T D"],
    share: Float[Array, "B T D"],
    noise: Float[Array, "B T N"] | None = None,
) -> Prediction:
    """Predict a batch of sequences; arguments as of `rollout`."""
    return read_out(network, rollout(network, initial, sensed, share, noise))


def read_out(network: MTRNN, potentials: Float[Array, "*rows N"]) -> Prediction:
    """Return what a network with these potentials predicts."""
    io = network.io_size
    variance = None
    if network.variance:
        variance = variance_of(network, jax.nn.sigmoid(potentials[..., io:]))
    return Prediction(jax.nn.sigmoid(potentials[..., :io]), variance, potentials)


def variance_of(network: MTRNN, context: Float[Array, "*rows C"]) -> Float[Array, "*rows D"]:
    """Return the variance that a network predicts, from y of its context units.

    It is read out of the context units, as in a stochastic continuous-time recurrent network
    (S-CTRNN: Murata, Namikawa, Arie, Sugano & Tani 2013), and is never fed back:
    v = exp(R y_context + r) + `LEAST_VARIANCE`.
    """
    weights, bias = network.variance_weights, network.variance_bias
    assert weights is not None and bias is not None, "asked of networks that predict variances"
    return jnp.exp(context @ weights.T + bias) + LEAST_VARIANCE
