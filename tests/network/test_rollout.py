"""The rollout computes equations (1) and (2), for any levels, wiring, mixing and noise."""

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from by_hand.network import rollout as by_hand
from cases import SHAPES, cases, potentials
from hypothesis import given
from hypothesis import strategies as st

from motionese.network import MTRNN, Level, rollout, step

BY_HAND = ("weights", "bias", "tau")


@pytest.mark.parametrize("shape", SHAPES, ids=str)
@given(data=st.data())
def test_equals_the_equations_by_hand(float64, shape, data):
    case = data.draw(cases(shape))

    for motion, path in enumerate(np.asarray(potentials(case.sizes)(*case.arguments()))):
        expected = by_hand(
            *(case.parts[name] for name in BY_HAND),
            case.sizes,
            *(case.parts[name][motion] for name in ("initial", "sensed", "share", "noise")),
        )
        np.testing.assert_allclose(path, expected, rtol=0, atol=1e-12)


def test_without_noise_equals_noise_of_zero(float64):
    network = MTRNN.draw([Level(2, 2.0), Level(3, 5.0)], key=jax.random.key(3))
    arguments = jnp.ones((1, 5)), jnp.full((1, 6, 2), 0.4), jnp.full((1, 6, 2), 0.5)
    compiled = eqx.filter_jit(rollout)

    silent = compiled(network, *arguments)

    np.testing.assert_allclose(silent, compiled(network, *arguments, jnp.zeros((1, 6, 5))))


def test_what_is_never_taken_changes_no_bit():
    network = MTRNN.draw([Level(2, 2.0), Level(3, 5.0), Level(1, 70.0)], key=jax.random.key(3))
    initial = jax.random.normal(jax.random.key(4), (2, 6))
    share = jnp.array([0.0, 1.0])[None, None].repeat(2, 0).repeat(5, 1)
    sensed = jax.random.uniform(jax.random.key(5), (2, 5, 2))

    compiled = eqx.filter_jit(rollout)

    one = compiled(network, initial, sensed, share)

    other = compiled(network, initial, sensed.at[..., 0].set(-1e6).at[:, -1].set(9.0), share)
    np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("tau", [1.0, 70.0])
def test_one_slow_unit_follows_its_time_constant(float64, tau):
    network = MTRNN.draw([Level(1, 2.0), Level(1, tau)], key=jax.random.key(0), gain=0.0)

    still = jnp.zeros((1, 41, 1))
    u = eqx.filter_jit(rollout)(network, jnp.ones((1, 2)), still, still)

    np.testing.assert_allclose(u[0, :, 1], (1 - 1 / tau) ** np.arange(41), atol=1e-14)


@pytest.mark.parametrize("sizes", [(2, 3), (6, 40), (6, 40, 2)])
@pytest.mark.parametrize("share", [1.0, 0.3, 0.0])
def test_a_step_comes_to_the_bits_of_a_rollout_of_two_rows(sizes, share):
    levels = [Level(size, 2.0 + place) for place, size in enumerate(sizes)]
    network = MTRNN.draw(levels, key=jax.random.key(3), gain=4.0)
    first, second = jax.random.split(jax.random.key(4))
    u = jax.random.normal(first, (network.size,))

    @eqx.filter_jit
    def two_rows(network, u, row, share):
        rows = jnp.stack([row, row])[None]
        return rollout(network, u[None], rows, jnp.full_like(rows, share))[0, 1]

    for row in jax.random.uniform(second, (20, sizes[0])):
        following = two_rows(network, u, row, jnp.asarray(share))
        u = step(network, u, row, jnp.asarray(share))
        np.testing.assert_array_equal(u, following)


def test_a_step_of_a_batch_mixes_each_channel_by_its_own_share(float64):
    network = MTRNN.draw([Level(2, 2.0), Level(3, 5.0)], key=jax.random.key(3))
    u = jax.random.normal(jax.random.key(4), (4, 5))
    sensed, share = jnp.full((4, 2), 0.9), jnp.array([1.0, 0.25])

    following = step(network, u, sensed, share)

    whole = rollout(network, u, sensed[:, None].repeat(2, 1), jnp.broadcast_to(share, (4, 2, 2)))
    np.testing.assert_allclose(following, whole[:, 1], rtol=0, atol=1e-14)
