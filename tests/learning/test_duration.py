"""The same motion, lasting longer or shorter."""

import jax
import numpy as np
import pytest

from motionese import MTRNN, Level, Motions, Training, generate, train
from motionese.errors import SettingError

ROWS = 61


@pytest.fixture(scope="module")
def slow(motions):
    """A fit of motions that move little from row to row, as recordings do."""
    times = [np.linspace(0.0, 4.0, ROWS) + phase for phase in (0.0, 1.5)]
    values = [
        np.stack([np.sin(t), np.cos(1.3 * t), np.sin(t) + np.cos(1.3 * t)], axis=1) for t in times
    ]
    slowly = Motions.from_arrays(values, motions.channels, rate_hz=20.0)
    levels = [Level(3, tau=2.0), Level(12, tau=5.0), Level(2, tau=70.0)]
    return train(MTRNN.draw(levels, key=jax.random.key(0)), slowly, settings=Training(epochs=1500))


@pytest.mark.parametrize("scale", [0.5, 0.75, 1.5, 2.0])
def test_a_path_of_another_duration_is_the_path_stretched_in_time(slow, motions, scale):
    rows = round((ROWS - 1) * scale) + 1
    once = generate(slow.network, slow.initial_states, ROWS)

    paths = generate(slow.network, slow.initial_states, rows, duration=scale)

    time = np.minimum(np.arange(rows) / scale, ROWS - 1)
    for path, usual in zip(paths, once, strict=True):
        stretched = np.stack([np.interp(time, np.arange(ROWS), c) for c in usual.T], axis=1)
        off = np.abs(path - stretched) / motions.channels.spans
        unscaled = np.abs(usual[: min(rows, ROWS)] - stretched[:ROWS]) / motions.channels.spans
        assert off.max() < 0.03
        assert unscaled.max() > 0.1


def test_the_usual_duration_gives_the_same_bits(slow):
    usual = generate(slow.network, slow.initial_states, ROWS)

    np.testing.assert_array_equal(
        generate(slow.network, slow.initial_states, ROWS, duration=1.0), usual
    )
    np.testing.assert_array_equal(
        generate(slow.network.lasting(1.5).lasting(2 / 3), slow.initial_states, 5), usual[:, :5]
    )


def test_the_network_itself_stays_as_it_was(slow):
    tau = np.array(slow.network.tau)

    longer = slow.network.lasting(2.0)

    np.testing.assert_array_equal(slow.network.tau, tau)
    np.testing.assert_array_equal(longer.tau, 2 * tau)
    assert longer.channels == slow.network.channels
    np.testing.assert_array_equal(longer.weights, slow.network.weights)


def test_durations_that_cannot_be_are_refused(slow):
    state = slow.initial_states[0]
    for scale in (0.4, 2.1):
        with pytest.raises(SettingError, match=rf"between 0\.5 and 2, got {scale}"):
            generate(slow.network, state, 20, duration=scale)
    fast = MTRNN.draw([Level(3, 1.5), Level(4, 5.0)], key=jax.random.key(0))
    with pytest.raises(SettingError, match=r"a time constant of 1\.5 steps shorter than a step"):
        fast.lasting(0.6)
