"""Training in batches of some motions: equal to steps by hand, each motion's memory its own."""

import subprocess
import sys
from dataclasses import replace

import jax
import numpy as np
import pytest

from motionese import MTRNN, Level, Motions, Training, train
from motionese.errors import SettingError
from motionese.learning.training import feed as feeding
from motionese.learning.training import pieces
from motionese.learning.training import trainer as training
from motionese.learning.training.feed import Feed
from motionese.learning.training.trainer import Trainer, make_trainer
from motionese.learning.training.training_state import checkpoint_facts

KEY = jax.random.key(4)
LEVELS = [Level(3, 2.0), Level(5, 5.0), Level(2, 70.0)]


@pytest.fixture(scope="module")
def net():
    return MTRNN.draw(LEVELS, key=jax.random.key(0))


@pytest.fixture(scope="module")
def seven(motions):
    """Seven motions of unequal lengths, three of which make up a batch at most."""
    values = [v * (1 - 0.05 * i) for i in range(3) for v in motions.values][:7]
    return Motions.from_arrays(values, motions.channels, motions.rate_hz)


def of_feed(motions, batch, **given):
    return Feed(motions, batch, **{"key": KEY, "padded_to": None, "devices": None, **given})


def trainer_of(net, motions, settings, **given):
    chosen = {"initial_states": None, "groups": {}, "validation": None, "key": KEY, **given}
    return make_trainer(net, motions, None, settings, **chosen)


def test_every_epoch_holds_every_motion_once_dealt_evenly_in_another_order(seven):
    feed = of_feed(seven, 3)
    first, second = (np.asarray(feed.part(start, 3)[1].motions) for start in (0, 3))

    assert first.shape == (3, 3) and feed.updates == 3
    for order in (first, second):
        assert sorted(order[order < 7].tolist()) == list(range(7))
        assert (np.sort((order < 7).sum(1)) == [2, 2, 3]).all()
    assert (first != second).any()
    np.testing.assert_array_equal(first, of_feed(seven, 3).part(0, 3)[1].motions)
    other = of_feed(seven, 3, key=jax.random.key(5)).part(0, 3)[1].motions
    assert (first != np.asarray(other)).any()


def by_hand(net, motions, settings, updates):
    """Adam by hand over gradients of `train` in whole batches; a motion's moments are its own."""
    trainer = trainer_of(net, motions, settings)
    order = np.concatenate(
        [np.asarray(trainer.feed.part(3 * e, 3)[1].motions) for e in range(-(-updates // 3))]
    )
    plain = {"optimiser": "descent", "weight_rate": 1.0, "initial_rate": 1.0, "clip": 0.0}
    step = Training(epochs=1, schedule="constant", bound={}, **plain)
    states = np.zeros((len(motions), net.size))
    moments = {name: [0.0, 0.0, 0] for name in ("weights", "bias", *range(len(motions)))}
    losses = []

    def moved(name, value, gradient, rate):
        mean, square, count = moments[name]
        mean, square, count = (
            0.9 * mean + 0.1 * gradient,
            0.999 * square + 0.001 * gradient**2,
            count + 1,
        )
        moments[name] = [mean, square, count]
        steps = mean / (1 - 0.9**count) / (np.sqrt(square / (1 - 0.999**count)) + 1e-8)
        return value - rate * steps

    for chosen in order[:updates]:
        own = [int(i) for i in chosen if i < len(motions)]
        some = motions.chosen(own)
        io = np.zeros(net.size, bool)
        io[: net.io_size] = True
        after = train(net, some, settings=step, initial_states=states[own])
        losses.append(after.losses[0])
        gradients = {
            name: np.asarray(getattr(net, name)) - np.asarray(getattr(after.network, name))
            for name in ("weights", "bias")
        }
        net = replace(
            net,
            **{
                name: np.asarray(
                    moved(name, np.asarray(getattr(net, name)), g, settings.weight_rate)
                )
                for name, g in gradients.items()
            },
        )
        for place, i in enumerate(own):
            gradient = np.where(io, 0.0, states[i] - after.initial_states[place])
            states[i] = moved(i, states[i], gradient, settings.initial_rate)
    return net, states, losses


def test_an_epoch_in_batches_is_adam_by_hand_with_moments_of_every_motions_own(float64, motions):
    net = MTRNN.draw(LEVELS, key=jax.random.key(0))
    values = [v * (1 - 0.05 * i) for i in range(3) for v in motions.values][:7]
    seven = Motions.from_arrays(values, motions.channels, motions.rate_hz)
    settings = Training(
        epochs=2,
        batch=3,
        weight_rate=0.01,
        initial_rate=0.05,
        schedule="constant",
        clip=0.0,
        bound={},
    )

    fit = train(net, seven, settings=settings, key=KEY)

    expected, states, losses = by_hand(net, seven, settings, 6)
    np.testing.assert_allclose(fit.losses, np.reshape(losses, (2, 3)).sum(1), rtol=1e-9)
    np.testing.assert_allclose(fit.network.weights, expected.weights, rtol=0, atol=1e-9)
    np.testing.assert_allclose(fit.network.bias, expected.bias, rtol=0, atol=1e-9)
    np.testing.assert_allclose(fit.initial_states[:, 3:], states[:, 3:], rtol=0, atol=1e-9)


def test_members_of_a_group_have_one_state_though_only_some_are_in_a_batch(net, seven):
    groups = {"cs": [0, 0, 0, 1, 1, 2, 0]}
    settings = Training(epochs=2, batch=3)

    fit = train(net, seven, settings=settings, key=KEY, shared=groups)

    slow, fast = fit.initial_states[:, 8:], fit.initial_states[:, 3:8]
    for i, j in ((0, 1), (0, 2), (0, 6), (3, 4)):
        np.testing.assert_array_equal(slow[i], slow[j])
        assert (fast[i] != fast[j]).all()
    assert (slow[0] != slow[3]).all() and (slow[3] != slow[5]).all()


def test_a_group_moves_by_the_mean_of_its_members_in_the_batch(float64, motions):
    net = MTRNN.draw(LEVELS, key=jax.random.key(0))
    four = Motions.from_arrays(
        [v * s for v in motions.values[:2] for s in (1.0, 0.9)], motions.channels, 10.0
    )
    plain = {"optimiser": "descent", "schedule": "constant", "clip": 0.0, "weight_rate": 0.0}
    settings = Training(epochs=1, batch=2, **plain)

    fit = train(net, four, settings=settings, key=KEY, shared={"cs": "aaaa"})

    state = np.zeros(net.size)
    for own in np.asarray(of_feed(four, 2).part(0, 2)[1].motions).tolist():
        alone = train(
            net,
            four.chosen(own),
            settings=settings.model_copy(update={"batch": 0}),
            initial_states=np.where(np.arange(net.size) < 8, 0.0, state)[None].repeat(2, 0),
        )
        state = alone.initial_states.mean(0)
    np.testing.assert_allclose(fit.initial_states[:, 8:], state[None, 8:].repeat(4, 0), atol=1e-12)


def test_training_stopped_within_an_epoch_goes_on_to_the_same_bits(
    net, seven, tmp_path, monkeypatch
):
    monkeypatch.setattr(feeding, "ROWS", 1)  # an update a call
    settings = Training(epochs=40, batch=3, noise={"cf": 0.1})
    given = {"settings": settings, "key": KEY, "checkpoint": tmp_path / "checkpoint"}
    whole = train(net, seven, settings=settings, key=KEY)
    advanced, calls = Trainer.advanced, []

    def stopped(trainer, state):
        calls.append(len(state.losses))
        if len(calls) == 5:
            raise KeyboardInterrupt
        return advanced(trainer, state)

    with monkeypatch.context() as patched:
        patched.setattr(Trainer, "advanced", stopped)
        with pytest.raises(KeyboardInterrupt):
            train(net, seven, **given)
    assert calls[-1] % 3 == 1, "one update of an epoch is done"
    assert checkpoint_facts(tmp_path / "checkpoint")["epochs"] == "1"
    resumed = train(net, seven, **given)

    for name in ("losses", "initial_states", "closed_loop_error"):
        np.testing.assert_array_equal(getattr(resumed, name), getattr(whole, name))
    np.testing.assert_array_equal(resumed.network.weights, whole.network.weights)
    assert len(whole.losses) == 40


def test_all_motions_in_one_batch_are_the_default_to_the_bit(net, motions):
    fits = [
        train(net, motions, settings=Training(epochs=3, batch=batch), key=KEY) for batch in (0, 3)
    ]
    np.testing.assert_array_equal(fits[0].network.weights, fits[1].network.weights)


@pytest.mark.slow
def test_errors_told_in_pieces_are_those_of_one_batch(net, seven, monkeypatch):
    settings = Training(epochs=2, batch=3)
    whole = train(net, seven, settings=settings, key=KEY, validation=seven.chosen([0, 1, 2]))
    monkeypatch.setattr(training, "ROWS", 60)
    monkeypatch.setattr(pieces, "RECOGNISED", 60)
    monkeypatch.setattr(training, "GLANCE", 2)
    some = train(net, seven, settings=settings, key=KEY, validation=seven.chosen([0, 1, 2]))

    assert [len(which) for which, _ in seven.batches(60)] == [2, 2, 2, 1]
    for name in ("initial_states", "closed_loop_error", "teacher_forced_error"):
        np.testing.assert_allclose(getattr(some, name), getattr(whole, name), rtol=1e-5, atol=1e-6)
    assert some.validation_error.shape == (3, 3)


def test_a_batch_that_cannot_be_is_refused_in_a_sentence(net, seven):
    with pytest.raises(SettingError, match=r"batch must be at most .* motions to learn, 7, got 8$"):
        train(net, seven, settings=Training(batch=8), key=KEY)
    with pytest.raises(SettingError, match="batches needs a key to shuffle by, got none"):
        train(net, seven, settings=Training(batch=3))
    with pytest.raises(SettingError, match="setting batch = -1: input should be greater"):
        Training(batch=-1)


def test_motions_read_when_needed_are_learned_to_the_same_bits(net, seven, tmp_path, monkeypatch):
    monkeypatch.setattr(feeding, "ROWS", 120)  # a call is of two updates, then of one
    seven.write(tmp_path / "seven.npz")
    stored, whole = (Motions.read(tmp_path / "seven.npz", stored=s) for s in (True, False))
    settings = Training(epochs=3, batch=3, noise={"cf": 0.1})

    fits = [train(net, motions, settings=settings, key=KEY) for motions in (stored, whole)]

    for name in ("losses", "initial_states", "closed_loop_error"):
        np.testing.assert_array_equal(getattr(fits[0], name), getattr(fits[1], name))
    np.testing.assert_array_equal(fits[0].network.weights, fits[1].network.weights)
    trainer = trainer_of(net, stored, settings)
    assert trainer.feed.whole is None and trainer.feed.length == 1
    other = trainer_of(net, stored.chosen([1, 0, 2, 3, 4, 5, 6]), settings)
    assert trainer.origin["motions"] != other.origin["motions"]


SPREAD = """
import jax, numpy as np
jax.config.update("jax_num_cpu_devices", 2)
jax.config.update("jax_enable_x64", True)
from motionese import MTRNN, Level, Motions, Training, train
t = np.linspace(0, 6, 20)[:, None]
motions = Motions.from_arrays([np.sin(t + [i, 2 * i]) for i in range(7)], ["x", "y"], 10.0)
net = MTRNN.draw([Level(2, 2.0), Level(6, 5.0), Level(2, 30.0)], key=jax.random.key(0))
for batch in (0, 3):
    settings = Training(epochs=6, batch=batch, noise={"cf": 0.1})
    one, two = (
        train(net, motions, settings=settings, key=jax.random.key(1), devices=jax.devices()[:n])
        for n in (1, 2)
    )
    for name in ("losses", "initial_states", "closed_loop_error"):
        np.testing.assert_allclose(getattr(two, name), getattr(one, name), rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(two.network.weights, one.network.weights, atol=1e-9)
    assert len(one.network.weights.devices()) == len(two.network.weights.devices()) == 1
"""


@pytest.mark.slow
def test_spread_over_two_devices_a_training_is_the_same_but_for_rounding():
    ran = subprocess.run(
        [sys.executable, "-c", SPREAD], capture_output=True, text=True, check=False
    )
    assert ran.returncode == 0, ran.stderr
