"""Generation in closed loop: from initial states, the network fed with its own predictions.

A motion may begin where it was learned, or where the robot actually is.
"""

from collections.abc import Mapping

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.arguments import refusing
from motionese.channels import Channels
from motionese.errors import ChannelError, SettingError
from motionese.network import MTRNN, Trained, network_of, rollout
from motionese.unit_interval import logit


@refusing()
def generate(
    network: MTRNN | Trained,
    initial_state: Float[ndarray, "*batch N"],
    steps: int,
    *,
    first: Float[ndarray, "*batch D"] | None = None,
    duration: float = 1.0,
) -> Float[ndarray, "*batch T D"]:
    """Generate motions in closed loop.

    Args:
        network: A network that carries channels, or what training left.
        initial_state: u_0 of all levels, of one motion or of a batch.
        steps: Rows T of the result.
        first: What is sensed at the first row, in the channels' units: the network's first
            input. Its own y_0 where left out, and for channels that are NaN.
        duration: How many times as long a motion lasts (0.5 to 2), through the time constants;
            its rows become more or fewer by as much.

    Returns:
        The path in the channels' units, binary channels held at their two values. Row 0 is
        `first`, and y_0 where that is not given.
    """
    network = network_of(network)
    lasting = network if duration == 1.0 else network.lasting(duration)
    return _closed_loop(lasting, initial_state, steps, first)[0]


@refusing()
def activity(
    network: MTRNN | Trained,
    initial_state: Float[ndarray, "*batch N"],
    steps: int,
    *,
    first: Float[ndarray, "*batch D"] | None = None,
) -> Float[ndarray, "*batch T N"]:
    """Return y of all units while the network generates, as `generate` does."""
    return _closed_loop(network_of(network), initial_state, steps, first)[1]


def carried(network: MTRNN) -> Channels:
    """Return the channels of a trained network; `ChannelError` if it carries none."""
    if network.channels is None:
        raise ChannelError("the network carries no channels; train it on motions first")
    return network.channels


@refusing()
def placed(
    network: MTRNN | Trained, initial_state: Float[ndarray, "*batch N"], here: Mapping[str, float]
) -> Float[ndarray, "*batch N"]:
    """Return initial states of motions that begin where the robot is.

    The IO units of the channels that are given start from the logit of what is sensed, as in
    training; context units keep the motion. Those of a network whose `initial_io` is "zero" stay
    at 0: it takes up where the robot is as its first input alone, `first` of `generate`.

    Args:
        network: A network that carries channels, or what training left.
        initial_state: u_0 of all levels, of one motion or of a batch.
        here: Where the robot is, by channel, in the channels' units.

    Raises:
        ChannelError: A channel that the network does not have, or a value that is not finite.
    """
    network = network_of(network)
    channels = carried(network)
    columns, values = channels.indices(here), np.full(len(channels), 0.0)
    values[columns] = list(here.values())
    wrong = [name for name, value in here.items() if not np.isfinite(value)]
    if wrong:
        raise ChannelError(
            f"channel '{wrong[0]}': where the robot is must be finite, got {here[wrong[0]]}"
        )
    states = _states(network, initial_state)
    if network.initial_io == "sensed":
        states[..., columns] = logit(channels.to_unit(values)[columns])
    return states


def _states(network: MTRNN, given: Float[ndarray, "*batch N"]) -> Float[ndarray, "*batch N"]:
    """Return a copy of initial states; `SettingError` if they are of another network."""
    states = np.array(given)
    if states.shape[-1] != network.size:
        raise SettingError(
            f"initial states must have one value per unit ({network.size}), got {states.shape[-1]}"
        )
    return states


def _closed_loop(
    network: MTRNN,
    initial_state: Float[ndarray, "*batch N"],
    steps: int,
    first: Float[ndarray, "*batch D"] | None,
) -> tuple[ndarray, ndarray]:
    channels, start = carried(network), _states(network, initial_state)
    if steps < 2:
        raise SettingError(f"steps must be ≥ 2, got {steps}")
    flat = jnp.asarray(start.reshape(-1, network.size), network.weights.dtype)
    sensed = np.full((len(flat), steps, network.io_size), 0.5)
    share = np.zeros_like(sensed)
    if first is not None:
        row = channels.to_unit(np.asarray(first)).reshape(-1, network.io_size)
        if len(row) != len(flat):
            raise SettingError(f"first must be one row for each of {len(flat)}, got {len(row)}")
        share[:, 0] = given = np.isfinite(row)
        sensed[:, 0] = np.where(given, row, 0.5)
    inputs = (jnp.asarray(part, flat.dtype) for part in (sensed, share))
    outputs = np.array(_outputs(network, flat, *inputs))
    if first is not None:
        io = outputs[:, 0, : network.io_size]
        io[:] = np.where(given, sensed[:, 0], io)
    outputs = outputs.reshape(*start.shape[:-1], steps, network.size)
    return channels.held(channels.from_unit(outputs[..., : network.io_size])), outputs


@eqx.filter_jit
def _outputs(network: MTRNN, initial: Array, sensed: Array, share: Array) -> Array:
    return jax.nn.sigmoid(rollout(network, initial, sensed, share))
