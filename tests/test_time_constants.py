"""Time constants of longer and shorter motions, and which scales are refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from motionese.errors import SettingError
from motionese.time_constants import scaled_tau


@given(scale=st.floats(0.5, 2.0))
def test_every_time_constant_is_scaled(scale):
    tau = np.array([2.0, 5.0, 70.0], np.float32)

    scaled = scaled_tau(tau, scale)

    np.testing.assert_allclose(scaled, [2 * scale, 5 * scale, 70 * scale], rtol=1e-6)
    assert scaled.dtype == np.float32


@pytest.mark.parametrize("scale", [0.4, 0.4999, 2.1, 0.0, -1.0, np.nan, np.inf])
def test_a_scale_outside_half_to_double_is_refused(scale):
    with pytest.raises(SettingError, match=rf"must lie between 0\.5 and 2, got {scale:g}"):
        scaled_tau(np.array([5.0, 70.0]), scale)


@pytest.mark.parametrize("shortest", [1.0, 1.1, 1.25, 1.4, 1.6, 1.9])
def test_no_time_constant_becomes_shorter_than_a_step(shortest):
    tau = np.array([shortest, 70.0], np.float32)

    with pytest.raises(SettingError, match=f"a time constant of {shortest:g} steps") as refused:
        scaled_tau(tau, 0.5)

    least = float(str(refused.value).rsplit(" ", 1)[1])
    assert least < 1 / shortest + 0.001
    assert scaled_tau(tau, least).min() >= 1, "what the sentence offers is allowed"
