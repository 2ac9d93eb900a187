"""Random networks with everything a rollout takes: few shapes, compiled once, any values."""

from dataclasses import dataclass
from functools import lru_cache

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from hypothesis import strategies as st

from motionese.network import MTRNN, Level, rollout

PARTS = ("weights", "bias", "tau", "initial", "sensed", "share", "noise")

SHAPES = [
    ((1, 1), 1, 1),
    ((2, 3), 7, 3),
    ((5, 1), 2, 1),
    ((3, 4, 2), 6, 2),
    ((4, 5, 4, 3), 4, 2),
    ((1, 2, 3, 1), 8, 1),
]
"""Sizes of 2–4 levels, rows, motions: among them a single row, unit, and motion."""


@dataclass(frozen=True)
class Case:
    """A network of some levels, and a batch; `parts` holds float64 arrays by name."""

    sizes: tuple[int, ...]
    parts: dict[str, np.ndarray]

    def arguments(self):
        """The parts as jax arrays, in the order PARTS; to be called in double precision."""
        return [jnp.asarray(self.parts[name]) for name in PARTS]


@lru_cache
def potentials(sizes):
    """The package's rollout as a function of all that has a gradient, in the order PARTS."""

    def compute(weights, bias, tau, initial, sensed, share, noise):
        network = MTRNN.draw([Level(size, 2.0) for size in sizes], key=jax.random.key(0))
        network = eqx.tree_at(lambda n: (n.weights, n.bias, n.tau), network, (weights, bias, tau))
        return rollout(network, initial, sensed, share, noise)

    return jax.jit(compute)


@st.composite
def cases(draw, shape):
    """Any τ and any mixing, with weights even where nothing is wired."""
    sizes, rows, batch = shape
    mixing = draw(st.sampled_from(["by channel and step", "closed loop", "forced", "shared"]))
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    units, io = sum(sizes), (batch, rows, sizes[0])
    share = {
        "by channel and step": rng.uniform(size=io),
        "closed loop": np.zeros(io),
        "forced": np.ones(io),
        "shared": np.full(io, 0.3),
    }[mixing]
    tau = np.where(rng.uniform(size=units) < 0.2, 1.0, rng.uniform(1.0, 80.0, units))
    parts = {
        "weights": rng.normal(0.0, 2.0, (units, units)),
        "bias": rng.normal(size=units),
        "tau": tau,
        "initial": rng.normal(0.0, 2.0, (batch, units)),
        "sensed": rng.uniform(0.02, 0.98, io),
        "share": share,
        "noise": rng.normal(0.0, 0.2, (batch, rows, units)),
    }
    return Case(sizes, parts)
