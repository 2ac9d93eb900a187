"""Smoothing and differentiation against polynomials fitted one by one, SciPy, and known motions."""

import numpy as np
import pytest
from by_hand.polynomials import fitted_one_by_one
from scipy.signal import savgol_filter
from stroke_motions import strokes

from motionese.kinematics.tracks import DEGREE, gains, polynomials, tracks_of, window_rows

RATE_HZ = 50.0


def whole(path):
    return np.ones(len(path), dtype=bool)


@pytest.mark.parametrize("missing", [[], [20, 21, 22], [0, 30, 32, 59]])
def test_polynomials_are_those_fitted_one_by_one(missing):
    rng = np.random.default_rng(0)
    times = np.delete(np.arange(60) / RATE_HZ, missing)
    values = rng.normal(size=(len(times), 3))
    at = np.arange(60) / RATE_HZ + 1e-4  # No row is as near as another.
    found = polynomials(times, values, at, 9)
    for column in range(3):
        expected = fitted_one_by_one(times, values[:, column], at, 9, DEGREE)
        # Coefficients grow with the rate's powers; within the window all count alike.
        scale = (9 / RATE_HZ) ** np.arange(DEGREE + 1)
        np.testing.assert_allclose(found[:, :, column] * scale, expected * scale, atol=1e-6)


@pytest.mark.parametrize("derivative", [0, 1, 2])
def test_without_gaps_it_is_the_filter_of_savitzky_and_golay(derivative):
    path = np.random.default_rng(1).normal(size=(80, 2))
    (track,) = tracks_of(path, whole(path), 200.0, 0.1)
    expected = savgol_filter(
        path, window_rows(200.0, 0.1), DEGREE, derivative, 1 / 200.0, axis=0, mode="interp"
    )
    found = (track.positions, track.speeds, track.accelerations)[derivative]
    if derivative:
        expected = np.linalg.norm(expected, axis=1)
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("rate_hz", [20.0, 30.0, 100.0, 240.0])
def test_a_quartic_and_its_derivatives_come_back(rate_hz):
    times = np.arange(int(3 * rate_hz)) / rate_hz
    curve = np.polynomial.Polynomial([0.1, -0.4, 0.5, 0.3, -0.2])
    path = np.stack([curve(times), 0 * times], axis=1)
    (track,) = tracks_of(path, whole(path), rate_hz, 0.25)

    assert track.times[0] == 0.0 and track.times[-1] == pytest.approx(times[-1])
    assert track.step_s <= 0.01 + 1e-12
    for found, order in ((track.speeds, 1), (track.accelerations, 2)):
        np.testing.assert_allclose(found, np.abs(curve.deriv(order)(track.times)), atol=1e-6)
    assert track.noise < 1e-9


def test_noise_is_told():
    rng = np.random.default_rng(2)
    path = strokes(1.0, 0.5, 100.0, 12)
    path = path + 0.002 * rng.normal(size=path.shape) * [1.0, 0.5]
    (track,) = tracks_of(path, whole(path), 100.0, 0.25)
    _, speed, acceleration = gains(100.0, 25)

    assert track.noise == pytest.approx(0.002 * np.hypot(1.0, 0.5), rel=0.1)
    assert (track.noise_speed, track.noise_acceleration) == pytest.approx(
        (track.noise * speed, track.noise * acceleration)
    )
    still = slice(5, 35)
    assert np.sqrt((track.speeds[still] ** 2).mean()) == pytest.approx(track.noise_speed, rel=0.5)


def test_short_gaps_are_bridged_and_long_ones_part():
    path = strokes(1.0, 0.5, 50.0)
    known = whole(path)
    known[60:65] = False
    (bridged,) = tracks_of(np.where(known[:, None], path, np.nan), known, 50.0, 0.25)
    (unbroken,) = tracks_of(path, whole(path), 50.0, 0.25)
    np.testing.assert_allclose(bridged.speeds, unbroken.speeds, atol=0.01 * unbroken.speeds.max())

    known[60:75] = False
    one, other = tracks_of(np.where(known[:, None], path, np.nan), known, 50.0, 0.25)
    assert (one.times[-1], other.times[0]) == (59 / 50, 75 / 50)


def test_stretches_shorter_than_a_window_are_left_out():
    path = strokes(1.0, 0.5, 50.0)
    known = whole(path)
    known[5:30] = False
    (track,) = tracks_of(path, known, 50.0, 0.25)
    assert track.times[0] == 30 / 50
