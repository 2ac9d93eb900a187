"""The adjoint derived by hand: against autodiff, finite differences, and the twin by hand."""

from functools import lru_cache

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from by_hand.gradients import gradients as by_hand
from cases import PARTS, SHAPES, cases, potentials
from hypothesis import given, settings
from hypothesis import strategies as st

every_shape = pytest.mark.parametrize("shape", SHAPES, ids=str)
few = settings(max_examples=6)


@lru_cache
def plain_scan(sizes):
    """Equations (1) and (2) as a scan that jax differentiates itself."""
    level = np.repeat(np.arange(len(sizes)), sizes)
    mask = np.abs(level[:, None] - level[None, :]) < 2

    def compute(weights, bias, tau, initial, sensed, share, noise):
        def step(u, row):
            s, m, n = row
            y = jax.nn.sigmoid(u)
            x = jnp.concatenate([m * s + (1 - m) * y[:, : sizes[0]], y[:, sizes[0] :]], axis=1)
            later = (1 - 1 / tau) * u + (x @ (mask * weights).T + bias) / tau + n
            return later, later

        rows = [jnp.swapaxes(a, 0, 1) for a in (sensed[:, :-1], share[:, :-1], noise[:, 1:])]
        _, later = jax.lax.scan(step, initial, tuple(rows))
        return jnp.concatenate([initial[:, None], jnp.swapaxes(later, 0, 1)], axis=1)

    return compute


@lru_cache
def compiled_gradient(function):
    return jax.jit(lambda outer, arguments: jax.vjp(function, *arguments)[1](outer))


def random_outer(case):
    return np.random.default_rng(5).normal(size=case.parts["noise"].shape)


def pulled_back(function, case):
    gradients = compiled_gradient(function)(jnp.asarray(random_outer(case)), case.arguments())
    return {name: np.asarray(value) for name, value in zip(PARTS, gradients, strict=True)}


def assert_close(name, got, expected, relative):
    size = np.linalg.norm(expected)
    assert np.linalg.norm(got - expected) <= relative * max(size, 1e-12), name


@every_shape
@given(data=st.data())
@few
def test_every_gradient_equals_autodiff_of_a_plain_scan(float64, shape, data):
    case = data.draw(cases(shape))
    got = pulled_back(potentials(case.sizes), case)

    for name, expected in pulled_back(plain_scan(case.sizes), case).items():
        assert_close(name, got[name], expected, 1e-10)


@every_shape
@given(data=st.data())
@few
def test_every_gradient_equals_unrolled_back_propagation(float64, shape, data):
    case = data.draw(cases(shape))
    got = pulled_back(potentials(case.sizes), case)

    path = np.asarray(potentials(case.sizes)(*case.arguments()))
    shared = [case.parts[name] for name in ("weights", "bias", "tau")]
    each = [
        by_hand(
            random_outer(case)[b],
            *shared,
            case.sizes,
            *(case.parts[name][b] for name in ("initial", "sensed", "share")),
            path[b],
        )
        for b in range(len(path))
    ]
    for name in PARTS:
        together = np.stack([one[name] for one in each])
        expected = together.sum(0) if name in ("weights", "bias", "tau") else together
        assert_close(name, got[name], expected, 1e-10)


@every_shape
@given(data=st.data())
@few
def test_every_gradient_equals_central_differences(float64, shape, data):
    case = data.draw(cases(shape))
    got = pulled_back(potentials(case.sizes), case)
    rng, outer, arguments = np.random.default_rng(6), random_outer(case), case.arguments()

    for place, name in enumerate(PARTS):
        direction = rng.normal(size=arguments[place].shape)
        below, above = (
            potentials(case.sizes)(
                *(a + h * direction if p == place else a for p, a in enumerate(arguments))
            )
            for h in (-1e-5, 1e-5)
        )
        slope = (outer * np.asarray(above - below)).sum() / 2e-5
        along = (got[name] * direction).sum()
        assert abs(along - slope) <= 1e-6 * (1 + abs(slope)), name


@every_shape
@given(data=st.data())
@few
def test_nothing_unwired_has_a_gradient(float64, shape, data):
    case = data.draw(cases(shape))
    got = pulled_back(potentials(case.sizes), case)["weights"]

    level = np.repeat(np.arange(len(case.sizes)), case.sizes)
    wired = np.abs(level[:, None] - level[None, :]) <= 1
    assert not got[~wired].any()
    assert got[wired].all() or len(case.parts["noise"][0]) == 1
