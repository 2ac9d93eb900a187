"""The Gaussian error, and the variance that a network learns to predict with it."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from by_hand import learning as by_hand
from ragged_motions import ragged, small_network

from motionese import MTRNN, Channel, Channels, Level, Motions, Training, recognise, train
from motionese.errors import SettingError
from motionese.learning import activity
from motionese.learning.error import ERRORS
from motionese.learning.objective import predictions
from motionese.network import variance_of


def test_the_gaussian_error_is_that_of_the_equations_by_hand(float64):
    net, (motions, twins) = small_network(), ragged()
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


@pytest.fixture(scope="module")
def noisy():
    """A path shown many times with noise that grows tenfold, and a fit that knows the noise."""
    rng, t = np.random.default_rng(0), np.linspace(0.0, 3.0, 30)
    path = np.stack([np.sin(t), np.cos(t)], 1)
    deviation = np.stack([0.02 * 10 ** (t / 3), np.full(30, 0.1)], 1)
    shown = [path + deviation * rng.standard_normal(path.shape) for _ in range(24)]
    channels = Channels([Channel("x", "", -2.0, 2.0), Channel("y", "", -2.0, 2.0)])
    motions = Motions.from_arrays(shown, channels, 10.0)
    net = MTRNN.draw([Level(2, 2.0), Level(20, 4.0)], key=jax.random.key(0), variance=True)
    chosen = Training(epochs=1000, error="gaussian", bound=0.0, weight_rate=0.02)
    return train(net, motions, settings=chosen), motions, deviation


@pytest.mark.slow
def test_the_variance_of_known_noise_is_learned(noisy):
    fit, motions, deviation = noisy
    y = activity(fit.network, fit.initial_states, 30, first=np.array(motions.values)[:, 0])
    variance = variance_of(fit.network, jnp.asarray(y[..., 2:]))
    learned = (np.sqrt(variance) * motions.channels.interval_widths).mean(0)
    np.testing.assert_allclose(np.log(learned[3:]), np.log(deviation[3:]), atol=np.log(1.35))


@pytest.mark.slow
def test_recognition_trusts_what_is_predicted_with_little_variance(noisy):
    fit, motions, _ = noisy
    found = recognise(fit.network, motions[0])

    batch = motions[0].batch()
    predicted = predictions(fit.network, batch, jnp.asarray(found.initial_state)[None], 0.0)
    assert found.loss == pytest.approx(float(ERRORS["gaussian"](predicted, batch)[0]), rel=1e-4)


def test_a_gaussian_error_without_a_variance_is_refused(network, motions):
    with pytest.raises(SettingError, match="'gaussian' needs a network that predicts variances"):
        train(network, motions, settings=Training(epochs=1, error="gaussian"))
