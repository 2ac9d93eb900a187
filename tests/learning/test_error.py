"""The Gaussian error, and the variance that a network learns to predict with it."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from by_hand import learning as by_hand

from motionese import MTRNN, Channel, Channels, Level, Motions, Training, recognise, train
from motionese.errors import SettingError
from motionese.learning import activity
from motionese.learning.error import ERRORS
from motionese.learning.objective import predictions
from motionese.learning.parameters import PARAMETERS, Parameters
from motionese.network import variance_of

CHANNELS = Channels([Channel("x", "cm", -2.0, 2.0), Channel("y", "cm", 0.0, 5.0)])
LENGTHS = (6, 4, 7)


def drawn():
    """A network whose variance depends on its context."""
    levels = [Level(2, 2.0), Level(3, 5.0), Level(2, 30.0)]
    net = MTRNN.draw(levels, key=jax.random.key(0), channels=CHANNELS, variance=True)
    read = jax.random.normal(jax.random.key(1), (2, 5))
    return replace(net, bias=jnp.linspace(-0.5, 0.5, 7), variance_weights=read)


def ragged():
    """Motions with gaps and weights, as Motions and in the unit interval for the twin."""
    rng = np.random.default_rng(0)
    values = [rng.uniform((-2.0, 0.0), (2.0, 5.0), (length, 2)) for length in LENGTHS]
    masks = [rng.uniform(size=value.shape) < 0.7 for value in values]
    weights = [rng.uniform(0.0, 2.0, value.shape) for value in values]
    motions = Motions.from_arrays(values, CHANNELS, 10.0, observed=masks, weights=weights)
    scaled = [0.1 + 0.8 * (value - (-2.0, 0.0)) / (4.0, 5.0) for value in values]
    return motions, list(zip(scaled, masks, weights, strict=True))


def test_the_gaussian_error_is_that_of_the_equations_by_hand(float64):
    net, (motions, twins) = drawn(), ragged()
    free = jax.random.normal(jax.random.key(2), (3, 7))
    batch = motions.batch(9)

    errors = ERRORS["gaussian"](predictions(net, batch, free, 0.3), batch)

    arrays = {name: np.asarray(value) for name, value in net.arrays.items()}
    arrays |= {"sizes": net.sizes, "initial_io": "sensed"}
    expected = [
        by_hand.gaussian_error(arrays, *each, 0.3)
        for each in zip(twins, np.asarray(free), strict=True)
    ]
    np.testing.assert_allclose(errors, expected, rtol=1e-9)


@pytest.mark.parametrize("name", PARAMETERS)
@pytest.mark.parametrize("error", ERRORS)
def test_every_parameter_has_the_slope_of_finite_differences(float64, name, error):
    if (name, error) == ("variance", "squared"):
        pytest.skip("no variance enters the squared error")
    motions, _ = ragged()
    batch, start = motions.batch(), Parameters(drawn(), jnp.ones((3, 7)))
    free = start.free((name,))

    @jax.jit
    def loss(free):
        now = start.moved(free)
        predicted = predictions(now.network, batch, now.initial_states, 0.3)
        return ERRORS[error](predicted, batch).sum()

    direction = jax.tree.map(lambda a: jnp.cos(jnp.arange(a.size)).reshape(a.shape), free)
    ahead, behind = (
        loss(jax.tree.map(lambda a, d, s=s: a + s * d, free, direction)) for s in (1e-6, -1e-6)
    )
    slope = sum(
        (a * d).sum()
        for a, d in zip(
            jax.tree.leaves(jax.grad(loss)(free)), jax.tree.leaves(direction), strict=True
        )
    )

    assert abs(slope) > 1e-3
    np.testing.assert_allclose(slope, (ahead - behind) / 2e-6, rtol=1e-5)


@pytest.fixture(scope="module")
def noisy():
    """A path shown many times with noise that grows tenfold, and a fit that knows the noise."""
    rng, t = np.random.default_rng(0), np.linspace(0.0, 3.0, 30)
    path = np.stack([np.sin(t), np.cos(t)], 1)
    deviation = np.stack([0.02 * 10 ** (t / 3), np.full(30, 0.1)], 1)
    shown = [path + deviation * rng.standard_normal(path.shape) for _ in range(40)]
    channels = Channels([Channel("x", "", -2.0, 2.0), Channel("y", "", -2.0, 2.0)])
    motions = Motions.from_arrays(shown, channels, 10.0)
    net = MTRNN.draw([Level(2, 2.0), Level(20, 4.0)], key=jax.random.key(0), variance=True)
    chosen = Training(epochs=1500, error="gaussian", bound=0.0, weight_rate=0.02)
    return train(net, motions, settings=chosen), motions, deviation


def test_the_variance_of_known_noise_is_learned(noisy):
    fit, motions, deviation = noisy
    y = activity(fit.network, fit.initial_states, 30, first=np.array(motions.values)[:, 0])
    variance = variance_of(fit.network, jnp.asarray(y[..., 2:]))
    learned = (np.sqrt(variance) * motions.channels.interval_widths).mean(0)
    np.testing.assert_allclose(np.log(learned[3:]), np.log(deviation[3:]), atol=np.log(1.35))


def test_recognition_trusts_what_is_predicted_with_little_variance(noisy):
    fit, motions, _ = noisy
    found = recognise(fit.network, motions[0])

    batch = motions[0].batch()
    predicted = predictions(fit.network, batch, jnp.asarray(found.initial_state)[None], 0.0)
    assert found.loss == pytest.approx(float(ERRORS["gaussian"](predicted, batch)[0]), rel=1e-4)


def test_a_gaussian_error_without_a_variance_is_refused(network, motions):
    with pytest.raises(SettingError, match="'gaussian' needs a network that predicts variances"):
        train(network, motions, settings=Training(epochs=1, error="gaussian"))
