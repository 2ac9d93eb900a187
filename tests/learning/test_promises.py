"""The promises of training, growth, recognition, and files, kept by every variant of a network."""

from itertools import product

import jax
import numpy as np
import pytest

from motionese import (
    MTRNN,
    Level,
    Motions,
    Recognition,
    Training,
    generate,
    grow,
    load,
    save,
    train,
)
from motionese.learning import Ending, recognise_all
from motionese.network import wiring

LEVELS = {
    2: (Level(3, 2.0), Level(9, 5.0)),
    3: (Level(3, 2.0), Level(9, 5.0), Level(2, 70.0)),
    4: (Level(3, 2.0), Level(6, 5.0), Level(3, 20.0), Level(2, 70.0)),
}
RATES = {"descent": (0.02, 0.2), "momentum": (0.01, 0.1), "adam": (0.01, 0.03)}
VARIANTS = list(product(LEVELS, RATES, (True, False), ("sensed", "zero"), ("fan_in", "one")))

# Every pair of choices of two different columns occurs among these.
QUICK = [
    (2, "descent", True, "sensed", "fan_in"),
    (2, "momentum", False, "zero", "one"),
    (2, "adam", True, "zero", "one"),
    (3, "descent", False, "zero", "one"),
    (3, "momentum", True, "sensed", "one"),
    (3, "adam", False, "sensed", "fan_in"),
    (4, "descent", True, "zero", "fan_in"),
    (4, "momentum", True, "zero", "fan_in"),
    (4, "adam", False, "sensed", "one"),
]


def test_the_quick_variants_cover_every_pair_of_choices():
    for one, other in ((a, b) for a in range(5) for b in range(a)):
        pairs = {(variant[one], variant[other]) for variant in VARIANTS}
        assert {(variant[one], variant[other]) for variant in QUICK} == pairs, (one, other)


@pytest.mark.parametrize(
    ("levels", "optimiser", "learned_bias", "initial_io", "scale"),
    [v if v in QUICK else pytest.param(*v, marks=pytest.mark.slow) for v in VARIANTS],
)
def test_every_variant_keeps_its_promises(
    motions, tmp_path, levels, optimiser, learned_bias, initial_io, scale
):
    net = MTRNN.draw(
        LEVELS[levels],
        key=jax.random.key(levels),
        learned_bias=learned_bias,
        initial_io=initial_io,
        scale=scale,
    )
    weight_rate, initial_rate = RATES[optimiser]
    settings = Training(
        epochs=100,
        optimiser=optimiser,
        weight_rate=weight_rate,
        initial_rate=initial_rate,
        bound=2.0,
    )

    fit = train(net, motions, settings=settings)

    learned(net, fit, motions, learned_bias, initial_io)
    repeated(train(net, motions, settings=settings), fit)
    kept_on_disk(fit, tmp_path / "fit")
    grown_without_influence(fit)
    recognised(fit, motions)


def learned(net, fit, motions, learned_bias, initial_io):
    weights, io = np.asarray(fit.network.weights), net.io_size
    assert fit.status.ending is Ending.STOPPED
    assert fit.losses[-1] < 0.8 * fit.losses[0]
    assert not weights[~wiring(net.sizes)].any()
    assert (weights != np.asarray(net.weights))[wiring(net.sizes)].mean() > 0.95
    assert np.asarray(fit.network.bias).any() == learned_bias
    np.testing.assert_array_equal(fit.network.tau, net.tau)
    assert fit.network.channels == motions.channels
    assert np.abs(fit.initial_states[:, io:]).max() <= 2.0
    assert np.abs(fit.initial_states[:, io:]).min(axis=1).all()
    first = [1 / (1 + np.exp(-state[:io])) for state in fit.initial_states]
    sensed = [motions.channels.to_unit(values[0]) for values in motions.values]
    expected = sensed if initial_io == "sensed" else np.full((3, io), 0.5)
    np.testing.assert_allclose(first, expected, atol=1e-6)


def repeated(again, fit):
    np.testing.assert_array_equal(again.losses, fit.losses)
    np.testing.assert_array_equal(again.network.weights, fit.network.weights)
    np.testing.assert_array_equal(again.initial_states, fit.initial_states)


def kept_on_disk(fit, path):
    save(path, fit)
    loaded = load(path)
    states = fit.initial_states
    np.testing.assert_array_equal(
        generate(loaded.network, states, 30), generate(fit.network, states, 30)
    )


def grown_without_influence(fit):
    grown = grow(fit.network, Level(2, 100.0), key=jax.random.key(9), influence=0.0)
    states = np.concatenate([fit.initial_states, np.ones((3, 2), np.float32)], axis=1)
    np.testing.assert_array_equal(
        generate(grown, states, 30), generate(fit.network, fit.initial_states, 30)
    )


def recognised(fit, motions):
    found = recognise_all(
        fit.network,
        Motions.from_arrays(motions.values, motions.channels, 10.0),
        starts=fit.initial_states[:, None],
        settings=Recognition(iterations=100, starts=0, rate=0.1),
    )
    for each, error in zip(found, fit.closed_loop_error, strict=True):
        ranges = np.array([c.high - c.low for c in motions.channels])
        assert each.error <= np.sqrt(((error / ranges) ** 2).mean()) + 1e-6
