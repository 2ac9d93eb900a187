"""Error regression: sensitivities as the network has them, steps that make the error smaller."""

import jax.numpy as jnp
import numpy as np
import pytest
from by_hand.least_squares import sensitivities as by_hand
from small_models import SIZES

from motionese.network import sensitivities
from motionese.runtime.error_regression import ErrorRegression

RNG = np.random.default_rng(3)


def window_of(rows=9):
    """Readings with gaps, in the unit interval, the first of one channel alone."""
    sensed = RNG.uniform(0.1, 0.9, (rows, 3))
    sensed[RNG.uniform(size=sensed.shape) < 0.3] = np.nan
    sensed[0] = [0.4, np.nan, np.nan]
    return sensed


@pytest.mark.parametrize("saved", ["sensed", "zero"], indirect=True)
def test_sensitivities_equal_the_networks_and_those_by_hand(saved, model):
    network, regression = saved[1], ErrorRegression(model, 100.0)
    sensed = window_of()
    u = regression.begun(RNG.normal(0.0, 1.0, 12), sensed[0])

    found = regression.linearised(u, sensed)

    share = np.zeros((1, 9, 3))
    share[0, 0] = np.isfinite(sensed[0])
    values = np.where(np.isfinite(sensed), sensed, 0.5)
    potentials, changes = sensitivities(
        network, jnp.asarray(u)[None], jnp.asarray(values)[None], jnp.asarray(share),
        jnp.arange(3, 12),
    )  # fmt: skip
    np.testing.assert_allclose(found.potentials[:-1], potentials[0], rtol=0, atol=2e-5)
    np.testing.assert_allclose(found.changes, changes[0], rtol=0, atol=2e-5)
    twin = by_hand(
        *(np.asarray(getattr(network, name), float) for name in ("weights", "bias", "tau")),
        SIZES, u, values, share[0], 7,
    )  # fmt: skip
    np.testing.assert_allclose(found.changes[:, 4], twin, rtol=0, atol=2e-5)


def test_rows_that_follow_are_those_of_a_longer_window_nothing_was_observed_in(model):
    regression, sensed = ErrorRegression(model, 100.0), window_of()
    u = regression.begun(RNG.normal(0.0, 1.0, 12), sensed[0])
    longer = regression.linearised(u, np.vstack([sensed, np.full((4, 3), np.nan)]))

    here = regression.linearised(u, sensed)
    outputs, changes = regression.continued(here, 4)

    np.testing.assert_allclose(here.potentials, longer.potentials[:10], rtol=0, atol=1e-6)
    np.testing.assert_allclose(outputs, longer.outputs[9:], rtol=0, atol=1e-6)
    np.testing.assert_allclose(changes, longer.changes[9:], rtol=0, atol=1e-6)
    assert longer.loss == pytest.approx(here.loss, rel=1e-6)


def test_a_state_moved_to_has_its_own_error_and_the_sensitivities_from_before(model):
    regression, sensed = ErrorRegression(model, 100.0), window_of()
    regression.precision = np.arange(1.0, 10.0, dtype=np.float32)
    u = regression.begun(RNG.normal(0.0, 1.0, 12), sensed[0])
    here, mean = regression.linearised(u, sensed), u - np.float32(0.1)
    near = u + np.where(np.arange(12) < 3, 0.0, 0.2).astype(np.float32)

    moved, anew = (
        regression.moved(here, near, sensed, mean),
        regression.linearised(near, sensed, mean),
    )

    for name in ("outputs", "potentials", "loss", "cost"):
        np.testing.assert_allclose(getattr(moved, name), getattr(anew, name), rtol=1e-5)
    assert moved.changes is here.changes
    assert moved.curvature is here.curvature


def test_error_and_its_slope_are_those_of_what_was_observed(model):
    regression, sensed = ErrorRegression(model, 100.0), window_of()
    u = regression.begun(RNG.normal(0.0, 1.0, 12), sensed[0])
    here = regression.linearised(u, sensed)

    y = here.outputs[1:, :3].astype(float)
    assert here.loss == pytest.approx(np.nansum((y - sensed[1:]) ** 2), rel=1e-5)
    for unit in (3, 8, 11):
        above, below = u.copy(), u.copy()
        above[unit] += 0.01
        below[unit] -= 0.01
        slope = (
            regression.linearised(above, sensed).loss - regression.linearised(below, sensed).loss
        ) / 0.02
        assert here.slope[unit - 3] == pytest.approx(slope / 2, abs=2e-3)


def test_steps_lead_to_where_the_motion_began_and_keep_within_the_bound(model):
    regression = ErrorRegression(model, 2.5)
    begin = regression.begun(model.initial("reach"), np.full(3, np.nan))
    outputs, _ = regression.predicted(begin, np.full(3, np.nan), 15)
    sensed = outputs[:, :3].astype(float)
    u = regression.begun(
        begin + np.where(np.arange(12) < 3, 0.0, 1.0).astype(np.float32), sensed[0]
    )
    here = first = regression.linearised(u, sensed)
    for _ in range(30):
        trial = regression.stepped(u, here)
        there = regression.linearised(trial, sensed)
        if regression.better(there, here):
            u, here = trial, there

    assert here.loss < 1e-3 * first.loss
    assert np.abs(u[3:]).max() <= 2.5


def test_the_prior_pulls_to_its_mean_as_hard_as_it_is_precise(model):
    regression, sensed = ErrorRegression(model, 100.0), window_of()
    u = regression.begun(RNG.normal(0.0, 1.0, 12), sensed[0])
    free = regression.linearised(u, sensed)
    regression.precision = np.arange(1.0, 10.0, dtype=np.float32)
    mean = u + np.float32(0.5)

    held = regression.linearised(u, sensed, mean)

    assert held.loss == free.loss
    assert held.cost == pytest.approx(free.loss + 0.25 * 45, rel=1e-5)
    np.testing.assert_allclose(held.slope, free.slope - 0.5 * regression.precision, atol=1e-5)
    np.testing.assert_allclose(
        held.curvature - free.curvature, np.diag(regression.precision), atol=1e-5
    )
    regression.damping = 1e-4
    nothing = np.full(sensed.shape, np.nan)
    there = regression.stepped(u, regression.linearised(u, nothing, mean))
    np.testing.assert_allclose(there[3:], mean[3:], atol=2e-3)


def test_what_nothing_was_observed_of_stays_where_it_was(model):
    regression = ErrorRegression(model, 100.0)
    u = regression.begun(RNG.normal(0.0, 1.0, 12), np.full(3, np.nan))
    here = regression.linearised(u, np.full((4, 3), np.nan))
    assert here.loss == 0
    np.testing.assert_array_equal(regression.stepped(u, here), u)
