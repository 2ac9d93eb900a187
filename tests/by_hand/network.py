"""Equations (1) and (2): one step, and a whole rollout."""

import math

import numpy as np


def sigmoid(value):
    return 1.0 / (1.0 + math.exp(-value))


def level_of(sizes):
    """The level of every unit."""
    return [level for level, size in enumerate(sizes) for _ in range(size)]


def wired(sizes, i, j):
    """Whether a weight leads from unit j to unit i: the same level, or neighbours."""
    level = level_of(sizes)
    return abs(level[i] - level[j]) <= 1


def inputs(u, sensed, share):
    """x of every unit: IO units mix what is sensed and their own prediction."""
    x = [sigmoid(value) for value in u]
    for channel in range(len(sensed)):
        x[channel] = share[channel] * sensed[channel] + (1.0 - share[channel]) * x[channel]
    return x


def summed_input(i, x, weights, bias, sizes):
    """Σ_j w_ij x_j + b_i."""
    return bias[i] + sum(weights[i][j] * x[j] for j in range(len(x)) if wired(sizes, i, j))


def step(u, x, weights, bias, tau, sizes):
    """Equation (1)."""
    return [
        (1.0 - 1.0 / tau[i]) * u[i] + summed_input(i, x, weights, bias, sizes) / tau[i]
        for i in range(len(u))
    ]


def rollout(weights, bias, tau, sizes, initial, sensed, share, noise=None):
    """Potentials u_0 … u_{T−1}. [T, N]"""
    path = [list(initial)]
    for t in range(1, len(sensed)):
        x = inputs(path[-1], sensed[t - 1], share[t - 1])
        u = step(path[-1], x, weights, bias, tau, sizes)
        if noise is not None:
            u = [value + noise[t][i] for i, value in enumerate(u)]
        path.append(u)
    return np.array(path)
