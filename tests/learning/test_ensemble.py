"""Many learners at once: each comes to what a training alone comes to, and ends by itself."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from motionese import MTRNN, Channel, Channels, Level, Motions, Training, train, train_ensemble
from motionese.errors import SettingError, StorageError
from motionese.learning import Ending, ensemble
from motionese.learning.training import side_by_side, trainer

LANES = side_by_side._lanes

LEVELS = [Level(3, 2.0), Level(5, 5.0), Level(2, 70.0)]
ARRAYS = (
    "initial_states",
    "losses",
    "validation_losses",
    "teacher_forced_error",
    "closed_loop_error",
    "validation_error",
)
LEARNED = ("weights", "bias", "tau", "initial_states")
QUICK = {
    "adam, noise": {"noise": {"cf": 0.2}},
    "momentum, learned tau": {
        "optimiser": "momentum",
        "weight_rate": 0.01,
        "initial_rate": 0.1,
        "learned": LEARNED,
    },
}
OTHERS = {
    "adam": {},
    "descent": {"optimiser": "descent", "weight_rate": 0.01, "initial_rate": 0.1, "clip": 0.0},
    "momentum, noise": {
        "optimiser": "momentum",
        "weight_rate": 0.01,
        "initial_rate": 0.1,
        "noise": {"cs": 0.1},
    },
    "constant rates": {"schedule": "constant", "bound": {"cf": 0.5}},
}


@pytest.fixture(scope="module")
def networks():
    return [MTRNN.draw(LEVELS, key=jax.random.key(seed)) for seed in range(3)]


@pytest.fixture
def accelerator(monkeypatch):
    """Map over the learners in one call, as where there is an accelerator."""
    monkeypatch.setattr(ensemble.jax, "default_backend", lambda: "gpu")


def same(one, other):
    """Whether two fits are equal bit by bit."""
    leaves = (jax.tree.leaves(fit.network) for fit in (one, other))
    return (
        all(np.array_equal(getattr(one, name), getattr(other, name)) for name in ARRAYS)
        and all(map(np.array_equal, *leaves))
        and one.status == other.status
    )


def keys(count):
    return list(jax.random.split(jax.random.key(7), count))


@pytest.fixture(autouse=True)
def short_chunks(monkeypatch):
    monkeypatch.setattr(trainer, "UPDATES", 10)


def singly(networks, sets, each_key, **given):
    """What a training alone makes of each."""
    return [
        train(network, own, key=key, **given)
        for network, own, key in zip(networks, sets, each_key, strict=True)
    ]


@pytest.mark.parametrize(
    "variant", [*QUICK, *(pytest.param(name, marks=pytest.mark.slow) for name in OTHERS)]
)
def test_on_a_cpu_every_learner_comes_to_the_bits_of_a_training_alone(networks, motions, variant):
    settings = Training(epochs=20, **(QUICK | OTHERS)[variant])
    given = {"settings": settings, "shared": {"cs": "aab"}}

    fits = train_ensemble(networks, motions, keys=keys(3), **given)

    assert not same(fits[0], fits[1])
    assert all(map(same, fits, singly(networks, [motions] * 3, keys(3), **given)))


def test_on_a_cpu_every_core_computes_as_precisely_as_the_caller(float64, motions):
    networks = [MTRNN.draw(LEVELS, key=jax.random.key(seed)) for seed in range(2)]

    fits = train_ensemble(networks, motions, epochs=10)

    assert fits[1].network.weights.dtype == np.float64
    assert all(map(same, fits, singly(networks, [motions] * 2, [None] * 2, epochs=10)))


def test_in_one_call_every_learner_comes_to_a_training_alone(
    float64, accelerator, motions, monkeypatch
):
    """Own motions, noise, time constants, and another end: two of three are left in the middle."""
    lanes = []
    monkeypatch.setattr(
        side_by_side,
        "_lanes",
        lambda latest, *rest: lanes.append(len(latest.updates)) or LANES(latest, *rest),
    )
    networks = [MTRNN.draw(LEVELS, key=jax.random.key(seed)) for seed in range(4)]
    sets = [motions, motions.chosen(["b", "a"]), motions.chosen("c"), motions.chosen("a")]
    settings = Training(
        epochs=40, learned=LEARNED, noise={"cf": 0.01}, patience=10, tolerance=0.4, weight_rate=0.01
    )

    fits = train_ensemble(networks, sets, keys=keys(4), settings=settings)

    alone = singly(networks, sets, keys(4), settings=settings, padded_to=(3, 30))
    for fit, other in zip(fits, alone, strict=True):
        assert fit.status == other.status
        for name in ARRAYS:
            np.testing.assert_allclose(getattr(fit, name), getattr(other, name), rtol=1e-8)
        for one, its in zip(*map(jax.tree.leaves, (fit.network, other.network)), strict=True):
            np.testing.assert_allclose(one, its, rtol=1e-8, atol=1e-10)
    assert lanes == [4, 4, 1], "three ended after two chunks"


@pytest.mark.parametrize("backend", ["cpu", "gpu"])
def test_a_learner_that_diverges_disturbs_no_other(monkeypatch, backend):
    monkeypatch.setattr(ensemble.jax, "default_backend", lambda: backend)
    levels = [Level(1, 2.0), Level(1, 1.0)]
    stable = [MTRNN.draw(levels, key=jax.random.key(seed)) for seed in (1, 2)]
    # At a fixed point that it leaves by a factor of 2.5e5 a step: its gradients overflow.
    weights, bias = jnp.array([[0.0, 1.0], [0.0, 1e6]]), jnp.array([0.0, -5e5])
    unstable = replace(stable[0], weights=weights, bias=bias)
    channels = Channels([Channel("x", "", 0.0, 1.0)])
    motions = Motions.from_arrays([np.linspace(0.0, 1.0, 12)[:, None]], channels, 10.0)
    networks, settings = [stable[0], unstable, stable[1]], Training(epochs=20, clip=0.0)

    fits = train_ensemble(networks, motions, settings=settings)

    assert [fit.status.ending for fit in fits] == [
        Ending.STOPPED,
        Ending.DIVERGED,
        Ending.STOPPED,
    ]
    assert "what was learned in 0 epochs is kept" in str(fits[1].status)
    np.testing.assert_array_equal(fits[1].network.weights, weights)
    for fit, network in zip(fits, networks, strict=True):
        alone = train(network, motions, settings=settings)
        np.testing.assert_allclose(fit.losses, alone.losses, rtol=1e-4)


@pytest.mark.parametrize("lost", [False, True])
def test_an_ensemble_goes_on_from_its_checkpoints_to_the_same_bits(
    networks, motions, tmp_path, lost
):
    settings, folder = Training(epochs=40), tmp_path / "checkpoints"
    whole = train_ensemble(networks, motions, settings=settings)
    told = []

    def interrupting(now):
        told.append([each.epoch for each in now])
        if len(told) == 2:
            raise KeyboardInterrupt

    given = {"settings": settings, "checkpoints": folder}
    with pytest.raises(KeyboardInterrupt):
        train_ensemble(networks, motions, progress=interrupting, **given)
    assert told == [[10, 10, 10], [20, 20, 20]]
    if lost:
        (folder / "1").unlink()
    told.clear()
    resumed = train_ensemble(networks, motions, progress=lambda now: told.append(now), **given)

    assert all(map(same, resumed, whole))
    assert [[each.epoch for each in now] for now in told] == (
        [[20, 10, 20], [20, 20, 20]] if lost else []
    ) + [[30, 30, 30], [40, 40, 40]]
    with pytest.raises(StorageError, match="checkpoints/0: this training was begun with other net"):
        train_ensemble(networks[1:], motions, **given)


def test_what_is_no_ensemble_is_refused(networks, motions):
    other = MTRNN.draw([Level(3, 2.0), Level(6, 5.0), Level(2, 70.0)], key=jax.random.key(0))
    with pytest.raises(SettingError, match="network 2 differs from network 0 in its sizes"):
        train_ensemble([*networks[:2], other], motions)
    wider = Motions.from_arrays([4 * value for value in motions.values], motions.channels.names, 10)
    with pytest.raises(SettingError, match="network 1 differs from network 0 in its channels"):
        train_ensemble(networks[:2], [motions, wider])
    with pytest.raises(SettingError, match="3 networks need as many sets of motions, got 2"):
        train_ensemble(networks, [motions] * 2)
    with pytest.raises(SettingError, match="3 networks need as many keys, got 1"):
        train_ensemble(networks, motions, keys=keys(1))
    with pytest.raises(SettingError, match="an ensemble needs at least one network, got none"):
        train_ensemble([], motions)
    with pytest.raises(SettingError, match="state noise needs a key, got none"):
        train_ensemble(networks, motions, settings=Training(noise={"cf": 0.1}))
