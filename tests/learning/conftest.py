"""Motions of different lengths over three channels, and a network that has learned them."""

import jax
import numpy as np
import pytest

from motionese import MTRNN, Channel, Channels, Level, Motions, Training, train

CHANNELS = Channels(
    [Channel("x", "cm", -2.0, 2.0), Channel("y", "cm", -1.5, 1.5), Channel("z", "rad", -3.0, 3.0)]
)


def path(phase, rows):
    """A closed curve in x and y, and z that follows from the two."""
    t = np.linspace(0.0, 4.0, rows) + phase
    return np.stack([np.sin(t), np.cos(1.3 * t), np.sin(t) + np.cos(1.3 * t)], axis=1)


@pytest.fixture(scope="session")
def motions():
    paths = [path(0.0, 24), path(1.5, 18), path(3.0, 30)]
    return Motions.from_arrays(paths, CHANNELS, rate_hz=10.0, names=["a", "b", "c"])


@pytest.fixture(scope="session")
def network():
    levels = [Level(3, tau=2.0), Level(12, tau=5.0), Level(2, tau=70.0)]
    return MTRNN.draw(levels, key=jax.random.key(0))


@pytest.fixture(scope="session")
def fit(network, motions):
    return train(network, motions, settings=Training(epochs=2000))
