"""Errors in the channels' units and as shares of their ranges, of what was observed alone."""

import numpy as np
import pytest

from motionese import Channel, Channels, Motions
from motionese.learning.accuracy import channel_errors, errors_of, share_of_range

CHANNELS = Channels([Channel("x", "cm", -2.0, 2.0), Channel("y", "deg", 0.0, 100.0)])


def test_channel_errors_are_root_means_over_what_was_observed():
    values = [np.array([[0.0, 50.0], [1.0, 60.0], [2.0, 70.0]]), np.array([[0.0, 0.0], [1.0, 5.0]])]
    seen = [np.array([[1, 1], [1, 0], [1, 1]], bool), np.array([[1, 1], [0, 1]], bool)]
    batch = Motions.from_arrays(values, CHANNELS, 10.0, observed=seen).batch()
    off = np.array([[9.0, 30.0], [0.3, 99.0], [-0.4, 7.0]])
    paths = [values[0] + off, np.vstack([values[1] - [0.0, 5.0], [[99.0, 99.0]]])]
    unit = np.stack([0.1 + 0.8 * (path - [-2.0, 0.0]) / [4.0, 100.0] for path in paths])

    errors = channel_errors(unit, batch, CHANNELS)

    # Row 0 is not predicted, what was not observed not known, and rows after the end are none.
    expected = [[np.sqrt((0.3**2 + 0.4**2) / 2), 7.0], [np.nan, 5.0]]
    np.testing.assert_allclose(errors, expected, rtol=1e-5)


def test_shares_of_range_leave_out_what_is_not_known():
    assert share_of_range(np.array([[0.4, np.nan], [np.nan, 20.0]]), CHANNELS) == pytest.approx(
        np.sqrt((0.1**2 + 0.2**2) / 2)
    )
    assert share_of_range(np.array([0.4, 30.0]), CHANNELS) == pytest.approx(np.sqrt(0.05))
    assert np.isnan(share_of_range(np.full((2, 2), np.nan), CHANNELS))
    assert np.isnan(share_of_range(np.zeros((0, 2)), CHANNELS))


@pytest.mark.slow
@pytest.mark.parametrize("forced", [0.0, 1.0])
def test_the_errors_of_a_fit_are_those_of_its_network(fit, motions, forced):
    told = fit.teacher_forced_error if forced else fit.closed_loop_error

    errors = errors_of(fit.network, motions.batch(), fit.initial_states, forced)

    np.testing.assert_allclose(errors, told, rtol=1e-3)
    assert fit.share(told) == pytest.approx(share_of_range(told, motions.channels))
    assert (fit.closed_loop_error > fit.teacher_forced_error).any()
