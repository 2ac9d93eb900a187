"""Training: what it promises for every optimiser, bound, noise, and ending."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from motionese import MTRNN, Channel, Channels, Level, Motions, Training, train
from motionese.errors import SettingError
from motionese.learning import Ending

RATES = {"descent": (0.01, 0.1), "momentum": (0.01, 0.1), "adam": (0.003, 0.01)}


def same(one, other):
    """Whether two fits are equal bit by bit."""
    return (
        np.array_equal(one.losses, other.losses)
        and np.array_equal(one.network.weights, other.network.weights)
        and np.array_equal(one.network.bias, other.network.bias)
        and np.array_equal(one.initial_states, other.initial_states)
    )


def settings(**given):
    return Training(**{"epochs": 100, **given})


@pytest.mark.parametrize("optimiser", RATES)
def test_the_loss_falls(network, motions, optimiser):
    weight_rate, initial_rate = RATES[optimiser]
    chosen = settings(
        epochs=300, optimiser=optimiser, weight_rate=weight_rate, initial_rate=initial_rate
    )

    fit = train(network, motions, settings=chosen)

    assert fit.losses.shape == (300,)
    assert fit.losses[-1] < 0.5 * fit.losses[0]
    assert fit.status.ending is Ending.STOPPED
    assert "all 300 epochs done" in str(fit.status)


def test_a_fit_reproduces_its_motions(fit, motions):
    assert fit.names == ("a", "b", "c")
    assert fit.network.channels == motions.channels
    assert fit.initial_states.shape == (3, 17)
    ranges = [c.high - c.low for c in motions.channels]
    assert (fit.closed_loop_error < 0.1 * np.array(ranges)).all()


def test_training_leaves_the_network_it_started_from(network, motions):
    before = np.array(network.weights)

    fit = train(network, motions, settings=settings())

    np.testing.assert_array_equal(network.weights, before)
    np.testing.assert_array_equal(fit.network.tau, network.tau)
    assert (np.asarray(fit.network.weights) != before)[before != 0].all()


def test_the_same_training_gives_the_same_bits(network, motions):
    assert same(train(network, motions, settings=settings()), train(network, motions, epochs=100))


def test_the_clip_limits_the_joint_step(network, motions):
    def moved(clip):
        chosen = settings(
            epochs=1, optimiser="descent", weight_rate=1.0, initial_rate=1.0, clip=clip, bound={}
        )
        fit = train(network, motions, settings=chosen)
        context = fit.initial_states[:, 3:]
        parts = (fit.network.weights - network.weights, fit.network.bias - network.bias, context)
        return np.sqrt(sum((np.asarray(part) ** 2).sum() for part in parts))

    assert moved(0.0) > 1.0
    assert moved(0.25) == pytest.approx(0.25, rel=1e-5)


def test_bounds_hold_after_every_update(network, motions):
    chosen = settings(epochs=1, initial_rate=10.0, bound={"cf": 0.5, "cs": 0.1}, clip=0.0)
    states, reached = None, 0.0
    for _ in range(6):
        states = train(network, motions, settings=chosen, initial_states=states).initial_states
        assert np.abs(states[:, 3:15]).max() <= 0.5
        assert np.abs(states[:, 15:]).max() <= np.float32(0.1)
        reached = max(reached, np.abs(states[:, 3:15]).max())
    assert reached == 0.5


@pytest.mark.slow
def test_state_noise_is_repeated_by_its_key_alone(network, motions):
    noisy = settings(noise={"cf": 0.2})
    first, again, other = (
        train(network, motions, settings=noisy, key=jax.random.key(k)) for k in (0, 0, 1)
    )

    assert same(first, again)
    assert not np.array_equal(first.losses, other.losses)
    assert not np.array_equal(first.losses, train(network, motions, settings=settings()).losses)


def test_state_noise_needs_a_key(network, motions):
    with pytest.raises(SettingError, match="state noise needs a key, got none"):
        train(network, motions, settings=settings(noise={"cf": 0.2}))


@pytest.mark.slow
def test_padding_changes_nothing_even_with_noise(float64, motions):
    net = MTRNN.draw([Level(3, 2.0), Level(5, 5.0), Level(2, 70.0)], key=jax.random.key(0))
    chosen, key = settings(epochs=20, noise={"cf": 0.2}), jax.random.key(5)

    plain = train(net, motions, settings=chosen, key=key)
    padded = train(net, motions, settings=chosen, key=key, padded_to=(5, 41))

    np.testing.assert_allclose(padded.losses, plain.losses, rtol=1e-10)
    np.testing.assert_allclose(padded.network.weights, plain.network.weights, rtol=0, atol=1e-10)
    np.testing.assert_allclose(padded.initial_states, plain.initial_states, rtol=0, atol=1e-10)
    np.testing.assert_allclose(padded.closed_loop_error, plain.closed_loop_error, rtol=1e-8)


def unstable():
    """A network at a fixed point that it leaves by a factor of 2.5e5 a step: gradients overflow."""
    net = MTRNN.draw([Level(1, 2.0), Level(1, 1.0)], key=jax.random.key(0))
    return replace(net, weights=jnp.array([[0.0, 1.0], [0.0, 1e6]]), bias=jnp.array([0.0, -5e5]))


def test_divergence_is_a_status_and_what_was_learned_before_is_kept():
    path = np.linspace(0.0, 1.0, 12)[:, None]
    motions = Motions.from_arrays([path], Channels([Channel("x", "", 0.0, 1.0)]), 10.0)

    fit = train(unstable(), motions, settings=Training(epochs=5, weight_rate=10.0, clip=0.0))

    assert fit.status.ending is Ending.DIVERGED
    assert fit.status.failed
    assert "what was learned in 0 epochs is kept" in str(fit.status)
    np.testing.assert_array_equal(fit.network.weights, unstable().weights)
    np.testing.assert_array_equal(fit.network.bias, unstable().bias)
    assert np.isfinite(fit.initial_states).all()


def test_training_stops_when_the_loss_no_longer_falls(network, motions):
    still = settings(epochs=500, weight_rate=0.0, initial_rate=0.0, patience=50)

    fit = train(network, motions, settings=still)

    assert fit.status.ending is Ending.CONVERGED
    assert "fell by less than 0.001 of itself in 50 epochs, at epoch 100" in str(fit.status)
    assert len(fit.losses) == 100
    assert not fit.status.failed


def test_patience_waits_while_the_loss_falls(network, motions):
    fit = train(network, motions, settings=settings(epochs=200, patience=50))

    assert fit.status.ending is Ending.STOPPED


@pytest.mark.slow
def test_held_out_motions_are_told_once_a_chunk(network, motions):
    told = []
    fit = train(
        network,
        motions,
        epochs=300,
        validation=motions,
        progress=told.append,
    )

    assert fit.validation_losses.shape == (3,)
    assert 0 < fit.validation_losses[-1] < fit.validation_losses[0]
    assert [each.epoch for each in told] == [100, 200, 300]
    assert [each.loss for each in told] == list(fit.losses[99::100])
    assert [each.validation_loss for each in told] == list(fit.validation_losses)
    assert told[-1].closed_loop_error == pytest.approx(fit.share(fit.closed_loop_error), rel=1e-6)
    assert same(fit, train(network, motions, epochs=300))


def test_patience_watches_the_held_out_motions_where_there_are_any(network, motions):
    still = settings(epochs=400, weight_rate=0.0, initial_rate=0.0, patience=100, tolerance=0.5)

    fit = train(network, motions, settings=still, validation=motions)

    assert fit.status.ending is Ending.CONVERGED
    assert len(fit.validation_losses) == 2


def test_a_network_that_carries_channels_keeps_their_scaling(fit, motions):
    names, doubled = motions.channels.names, [2 * value for value in motions.values]
    elsewhere = Motions.from_arrays(doubled, names, 10.0)
    same_channels = Motions.from_arrays(doubled, motions.channels, 10.0)
    assert elsewhere.channels != motions.channels

    one, other = (train(fit.network, m, epochs=100) for m in (elsewhere, same_channels))

    assert one.network.channels == motions.channels
    assert same(one, other)
    np.testing.assert_array_equal(one.closed_loop_error, other.closed_loop_error)


def test_what_does_not_fit_the_network_is_refused(network, fit, motions):
    other = Motions.from_arrays(motions.values, ["x", "y", "w"], 10.0)
    two = Motions.from_arrays([v[:, :2] for v in motions.values], ["x", "y"], 10.0)
    with pytest.raises(SettingError, match="channels are x, y, z, the motions' x, y, w"):
        train(fit.network, other)
    with pytest.raises(SettingError, match="the network has 3 IO units, the motions 2 channels"):
        train(network, two)
    with pytest.raises(SettingError, match=r"shape \(3, 17\), got \(2, 17\)"):
        train(network, motions, initial_states=np.zeros((2, 17)))
    with pytest.raises(SettingError, match=r"unknown level 'ccf'; did you mean 'cf'\?"):
        train(network, motions, settings=settings(bound={"ccf": 1.0}))
    with pytest.raises(SettingError, match="epochs must be ≥ 1, got 0"):
        train(network, motions, epochs=0)


def test_training_goes_on_from_a_fit(fit, motions):
    others = motions.chosen(["c", "a"])
    still = Training(epochs=1, weight_rate=0, initial_rate=0)
    gone_on = train(fit, others, settings=still)

    np.testing.assert_allclose(gone_on.initial_states, fit.initial_states[[2, 0]], atol=1e-6)
    np.testing.assert_allclose(
        gone_on.closed_loop_error, fit.closed_loop_error[[2, 0]], rtol=1e-3, atol=1e-5
    )
    unknown = replace(others, names=("c", "new"))
    new = train(fit, unknown, settings=still).initial_states[1, fit.network.io_size :]
    np.testing.assert_array_equal(new, 0)
    with pytest.raises(SettingError, match="20 rows a second, the model was trained at 10"):
        train(fit, replace(motions, rate_hz=20.0))


def test_a_fit_after_another_has_the_losses_of_both(fit, motions):
    both = train(fit, motions, epochs=3).after(fit)

    assert len(both.losses) == len(fit.losses) + 3
    assert both.status.sentence == "all 3 epochs done, after 2000 before"
