"""Time constants that are learned: one factor a level, found again in data whose τ is known."""

from dataclasses import replace

import jax
import numpy as np
import pytest

from motionese import MTRNN, Channel, Channels, Level, Motions, Training, generate, train

CHANNELS = Channels([Channel(name, "", 0.0, 1.0) for name in "xyz"])
TRUE = (2.0, 6.0, 40.0)


def levels(*tau):
    return [Level(size, t) for size, t in zip((3, 12, 3), tau, strict=True)]


def generated():
    """Motions of a network whose time constants are `TRUE`, the network, and their u_0."""
    teacher = MTRNN.draw(levels(*TRUE), key=jax.random.key(0), gain=5.0, channels=CHANNELS)
    states = 2 * np.asarray(jax.random.normal(jax.random.key(1), (6, teacher.size)))
    paths = generate(teacher, states, 60)
    return teacher, Motions.from_arrays(paths, CHANNELS, 10.0), states


@pytest.mark.slow
def test_time_constants_are_recovered_within_a_tenth():
    teacher, motions, states = generated()
    wrong = np.asarray(MTRNN.draw(levels(3.0, 3.0, 15.0), key=jax.random.key(0)).tau)
    chosen = Training(
        epochs=600, learned=("tau",), weight_rate=0.02, clip=0.0, schedule="constant", bound=100.0
    )

    fit = train(replace(teacher, tau=wrong), motions, settings=chosen, initial_states=states)

    assert [level.tau for level in fit.network.levels] == pytest.approx(TRUE, rel=0.1)
    np.testing.assert_array_equal(fit.network.weights, teacher.weights)
    assert fit.losses[-1] < 0.05 * fit.losses[0]


def test_all_units_of_a_level_change_by_one_factor_and_a_tau_of_one_stays(network, motions):
    own = [Level(3, (1.0, 1.0, 3.0)), Level(3, (3.0, 5.0, 9.0)), Level(2, 30.0)]
    net = MTRNN.draw(own, key=jax.random.key(0))

    learned = ("weights", "tau", "initial_states")
    fit = train(net, motions, settings=Training(epochs=40, learned=learned))

    tau = np.asarray(fit.network.tau)
    assert (tau[:2] == 1).all()
    factors = (tau[2:] - 1) / (np.asarray(net.tau)[2:] - 1)
    np.testing.assert_allclose(factors[1:4], factors[1], rtol=1e-5)
    np.testing.assert_allclose(factors[4:], factors[4], rtol=1e-5)
    assert len({float(f) for f in factors[[0, 1, 4]]}) == 3
    assert (np.abs(factors - 1) > 1e-3).all()
    assert (fit.network.bias == 0).all(), "not named, not learned"


def test_without_tau_among_the_learned_it_stays(network, motions):
    fit = train(network, motions, settings=Training(epochs=5))

    np.testing.assert_array_equal(fit.network.tau, network.tau)
