"""Growth: what was learned is kept, bit by bit where the new level has no influence."""

from dataclasses import replace

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest

from motionese.errors import SettingError
from motionese.network import MTRNN, Level, grow, predict, rollout

NEW = Level(2, tau=70.0)


def network(*sizes, key=0):
    levels = [Level(size, 1.0 + 3.0 * place) for place, size in enumerate(sizes)]
    return MTRNN.draw(levels, key=jax.random.key(key))


def run(net, rows=12, batch=3):
    """A rollout that depends on the network's size only through the new units' initial states."""
    first, second, third = jax.random.split(jax.random.key(8), 3)
    initial = 2 * jax.random.normal(first, (200, batch)).T[:, : net.size]
    shape = (batch, rows, net.io_size)
    sensed, share = jax.random.uniform(second, shape), jax.random.uniform(third, shape)
    return np.asarray(eqx.filter_jit(rollout)(net, initial, sensed, share))


@pytest.mark.parametrize(
    ("sizes", "new"),
    [
        ((6, 40), 2),
        ((1, 1), 31),
        ((6, 26), 1),
        pytest.param((2, 30, 4), 14, marks=pytest.mark.slow),
        pytest.param((7, 90), 30, marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize("batch", [1, 9])
def test_without_influence_the_old_units_compute_the_same_bits(sizes, new, batch):
    old = network(*sizes)

    grown = grow(old, Level(new, 70.0), key=jax.random.key(1), influence=0.0)

    np.testing.assert_array_equal(run(grown, batch=batch)[..., : old.size], run(old, batch=batch))


@pytest.mark.slow
def test_without_influence_repeated_growth_still_computes_the_same_bits():
    old = network(3, 14)
    grown = old
    for key in range(4):
        grown = grow(grown, Level(6, 50.0 + key), key=jax.random.key(key), influence=0.0)

    assert [level.name for level in grown.levels] == ["io", "cf", "cs", "c4", "c5", "c6"]
    np.testing.assert_array_equal(run(grown)[..., : old.size], run(old))


@pytest.mark.parametrize("influence", [0.0, 0.25, 1.0])
def test_old_weights_bias_and_time_constants_are_kept(influence):
    old = network(3, 8)
    old = replace(old, bias=jnp.linspace(-1.0, 1.0, old.size))

    grown = grow(old, NEW, key=jax.random.key(1), influence=influence)

    np.testing.assert_array_equal(grown.weights[: old.size, : old.size], old.weights)
    np.testing.assert_array_equal(grown.bias, [*old.bias, 0, 0])
    np.testing.assert_array_equal(grown.tau, [*old.tau, 70, 70])


def test_the_influence_scales_the_weights_to_the_level_below_and_no_others():
    old = network(3, 8)
    whole, quarter, default = (
        np.asarray(grow(old, NEW, key=jax.random.key(1), **given).weights)
        for given in ({"influence": 1.0}, {"influence": 0.25}, {})
    )

    expected = whole.copy()
    expected[: old.size, old.size :] *= 0.25
    np.testing.assert_array_equal(quarter, expected)
    np.testing.assert_array_equal(default, quarter)
    assert whole[3 : old.size, old.size :].all()
    assert not whole[:3, old.size :].any()


def test_weights_without_influence_have_a_gradient_and_leave_zero():
    grown = grow(network(3, 8), NEW, key=jax.random.key(1), influence=0.0)
    target = jnp.full((2, 10, 3), 0.8)

    def error(net):
        u = rollout(net, jnp.zeros((2, net.size)), target, jnp.full(target.shape, 0.3))
        return ((jax.nn.sigmoid(u[..., :3]) - target) ** 2).sum()

    gradient = np.asarray(eqx.filter_jit(eqx.filter_grad(error))(grown).weights)

    assert gradient[3:11, 11:].all()
    assert not gradient[:3, 11:].any()


@pytest.mark.parametrize("influence", [-0.1, np.nan, np.inf])
def test_an_influence_below_zero_is_refused(influence):
    with pytest.raises(SettingError, match="influence of a new level must be ≥ 0, got"):
        grow(network(3, 8), NEW, key=jax.random.key(1), influence=float(influence))


@pytest.mark.slow
def test_a_variance_that_was_learned_is_kept():
    old = MTRNN.draw([Level(2, 2.0), Level(4, 5.0)], key=jax.random.key(0), variance=True)
    old = replace(old, variance_weights=jax.random.normal(jax.random.key(1), (2, 4)))

    grown = grow(old, NEW, key=jax.random.key(2), influence=0.0)

    sensed, share = jnp.full((3, 8, 2), 0.4), jnp.full((3, 8, 2), 0.5)
    before = predict(old, jnp.ones((3, 6)), sensed, share)
    after = predict(grown, jnp.ones((3, 8)), sensed, share)
    assert grown.variance_weights.shape == (2, 6)
    np.testing.assert_allclose(after.variance, before.variance, rtol=1e-5)
