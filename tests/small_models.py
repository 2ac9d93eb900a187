"""A network of three levels over three channels in a file, for the runtime to read."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np

from motionese.channels import Channel, Channels
from motionese.network import MTRNN, Level, write_network
from motionese.runtime import timing

CHANNELS = Channels(
    [
        Channel("lift", "rad", -1.0, 2.0),
        Channel("turn", "°", -90.0, 45.0),
        Channel("grip", "", 0, 1),
    ]
)
SIZES = (3, 7, 2)
INITIAL_IO = ("sensed", "zero")
"""What the IO units of a network may begin at."""
NAMES = ("reach", "wave")


def written(path, *, initial_io="sensed", facts=None):
    """Write a model with weights everywhere, wired or not; returns its network and u_0."""
    levels = [Level(3, 2.0), Level(7, tuple(np.linspace(1.25, 6.0, 7))), Level(2, 30.0)]
    network = MTRNN.draw(levels, key=jax.random.key(0), channels=CHANNELS, initial_io=initial_io)
    rng = np.random.default_rng(0)
    network = replace(
        network,
        weights=jnp.asarray(rng.normal(0.0, 1.2, (12, 12)), jnp.float32),
        bias=jnp.asarray(rng.normal(size=12), jnp.float32),
    )
    states = rng.normal(size=(2, 12)).astype(np.float32)
    told = {"names": list(NAMES), "status": "stopped", "sentence": "", **(facts or {})}
    write_network(path, network, {"initial_states": states, "losses": np.zeros(3)}, told)
    return network, states


def nothing_learned(fit):
    """A fit as it was before any motion was learned."""
    none = {
        name: np.zeros((0, fit.network.io_size))
        for name in ("teacher_forced_error", "closed_loop_error", "validation_error")
    }
    states = np.zeros((0, fit.network.size), np.float32)
    return replace(fit, names=(), lengths=(), initial_states=states, validation_names=(), **none)


class Clock(timing.Clock):
    """Time that passes when somebody sleeps, or when a test says so."""

    def __init__(self):
        self.time = 100.0

    def now(self):
        return self.time

    def sleep_until(self, moment):
        self.time = max(self.time, moment)
