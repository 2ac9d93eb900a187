"""How predictions change with initial states: against autodiff, differences, and the twin."""

from functools import lru_cache

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from by_hand.least_squares import sensitivities as by_hand
from cases import SHAPES, cases
from hypothesis import given, settings
from hypothesis import strategies as st

from motionese.network import MTRNN, Level, rollout, sensitivities

every_shape = pytest.mark.parametrize("shape", SHAPES, ids=str)
few = settings(max_examples=4)


@lru_cache
def compiled(sizes):
    """The package's sensitivities, and autodiff of its predictions, in double precision."""
    blank = MTRNN.draw([Level(size, 2.0) for size in sizes], key=jax.random.key(0))

    def network(weights, bias, tau):
        return eqx.tree_at(lambda n: (n.weights, n.bias, n.tau), blank, (weights, bias, tau))

    def predicted(initial, weights, bias, tau, sensed, share):
        path = rollout(network(weights, bias, tau), initial, sensed, share)
        return jax.nn.sigmoid(path[..., : sizes[0]])

    def direct(initial, weights, bias, tau, sensed, share, units):
        return sensitivities(network(weights, bias, tau), initial, sensed, share, units)

    return jax.jit(direct), jax.jit(jax.jacrev(predicted)), jax.jit(predicted)


def parts_of(case):
    return [
        jnp.asarray(case.parts[name])
        for name in ("initial", "weights", "bias", "tau", "sensed", "share")
    ]


@every_shape
@given(data=st.data())
@few
def test_they_equal_autodiff_differences_and_the_twin(float64, shape, data):
    case = data.draw(cases(shape))
    direct, autodiff, predicted = compiled(case.sizes)
    parts = parts_of(case)
    units = np.arange(sum(case.sizes))[::2]

    potentials, got = direct(*parts, jnp.asarray(units))

    batch = len(parts[0])
    whole = np.asarray(autodiff(*parts))[np.arange(batch), :, :, np.arange(batch)]
    expected = np.moveaxis(whole[..., units], -1, 2)
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-10)
    np.testing.assert_allclose(
        jax.nn.sigmoid(potentials[..., : case.sizes[0]]), predicted(*parts), rtol=0, atol=1e-12
    )
    for place, unit in enumerate(units):
        shift = np.zeros(parts[0].shape)
        shift[:, unit] = 1e-5
        above, below = (predicted(parts[0] + s, *parts[1:]) for s in (shift, -shift))
        np.testing.assert_allclose(got[:, :, place], (above - below) / 2e-5, rtol=0, atol=1e-6)
    twin = by_hand(
        *(case.parts[name] for name in ("weights", "bias", "tau")),
        case.sizes,
        *(case.parts[name][0] for name in ("initial", "sensed", "share")),
        units[-1],
    )
    np.testing.assert_allclose(got[0, :, -1], twin, rtol=0, atol=1e-10)
