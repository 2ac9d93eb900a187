"""What every error of `ERRORS` promises, whatever is learned by it: a new one is a row there."""

from dataclasses import replace

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from ragged_motions import ragged, small_network

from motionese.learning.error import ERRORS
from motionese.learning.objective import predictions
from motionese.learning.parameters import PARAMETERS, Parameters, learned_by


@pytest.fixture(params=ERRORS)
def error(request):
    return ERRORS[request.param]


@pytest.fixture
def batch():
    return ragged()[0].batch(9)


@pytest.fixture
def predicted(float64, batch):
    free = jax.random.normal(jax.random.key(2), (3, 7))
    return predictions(small_network(), batch, free, 0.3)


def test_it_is_one_number_a_motion(error, predicted, batch):
    assert error(predicted, batch).shape == (3,)


def test_nothing_is_better_than_what_was_observed(error, predicted, batch):
    perfect = error(predicted._replace(mean=batch.sensed), batch)
    assert (np.asarray(error(predicted, batch)) > np.asarray(perfect)).all()


def test_what_weighs_nothing_and_the_first_row_count_for_nothing(error, predicted, batch):
    told = error(predicted, batch)
    idle = jnp.asarray(batch.weight == 0).at[:, 0].set(True)
    elsewhere = predicted._replace(mean=jnp.where(idle, 0.5, predicted.mean))
    np.testing.assert_array_equal(error(elsewhere, batch), told)


def test_it_is_linear_in_the_weight(error, predicted, batch):
    doubled = batch._replace(weight=2 * batch.weight)
    np.testing.assert_allclose(error(predicted, doubled), 2 * error(predicted, batch), rtol=1e-12)


def test_a_motion_does_not_depend_on_its_company(error, predicted, batch):
    alone = type(batch)(*(part[1:2] for part in batch))
    own = type(predicted)(*(part[1:2] for part in predicted))
    np.testing.assert_allclose(error(own, alone), error(predicted, batch)[1:2], rtol=1e-12)


@pytest.mark.parametrize("name", PARAMETERS)
def test_every_parameter_has_the_slope_of_finite_differences(float64, error, name, batch):
    if name == "variance" and not error.variance:
        pytest.skip("no variance enters this error")
    start = Parameters(small_network(), jnp.ones((3, 7)))
    free = start.free((name,))

    @jax.jit
    def loss(free):
        now = start.moved(free)
        return error(predictions(now.network, batch, now.initial_states, 0.3), batch).sum()

    direction = jax.tree.map(lambda a: jnp.cos(jnp.arange(a.size)).reshape(a.shape), free)
    ahead, behind = (
        loss(jax.tree.map(lambda a, d, s=s: a + s * d, free, direction)) for s in (1e-6, -1e-6)
    )
    slopes = jax.tree.map(lambda g, d: (g * d).sum(), jax.grad(loss)(free), direction)
    slope = sum(jax.tree.leaves(slopes))
    assert abs(slope) > 1e-3
    np.testing.assert_allclose(slope, (ahead - behind) / 2e-6, rtol=1e-5)


@pytest.mark.parametrize("name", PARAMETERS)
def test_free_values_of_a_parameter_give_it_back_and_touch_no_other(name):
    start = Parameters(small_network(), jnp.ones((3, 7)))
    same = start.moved(start.free((name,)))
    for ours, theirs in zip(jax.tree.leaves(same), jax.tree.leaves(start), strict=True):
        np.testing.assert_array_equal(ours, theirs)
    moved = start.moved(jax.tree.map(lambda a: a + 0.5, start.free((name,))))
    for other in set(PARAMETERS) - {name}:
        for ours, theirs in zip(
            jax.tree.leaves(PARAMETERS[other].place(moved)),
            jax.tree.leaves(PARAMETERS[other].place(start)),
            strict=True,
        ):
            np.testing.assert_array_equal(ours, theirs)
    assert any(
        (np.asarray(a) != np.asarray(b)).any()
        for a, b in zip(
            jax.tree.leaves(PARAMETERS[name].place(moved)),
            jax.tree.leaves(PARAMETERS[name].place(start)),
            strict=True,
        )
    )


def test_a_network_without_a_bias_or_a_variance_has_none_to_learn():
    network = small_network()
    without = replace(network, learned_bias=False, variance_weights=None, variance_bias=None)
    assert learned_by(network, tuple(PARAMETERS)) == tuple(PARAMETERS)
    assert set(PARAMETERS) - set(learned_by(without, tuple(PARAMETERS))) == {"bias", "variance"}
