"""Damped Gauss-Newton steps of initial states, with sensitivities summed path by path."""

import math

import numpy as np

from by_hand.learning import shares, start
from by_hand.network import rollout, sigmoid, wired


def sensitivities(weights, bias, tau, sizes, initial, sensed, share, unit):
    """∂y_{i,t}/∂u_{unit,0} of the IO units, by the chain rule from row to row. [T, D]"""
    path = rollout(weights, bias, tau, sizes, initial, sensed, share)
    io, units = len(sensed[0]), len(initial)
    change = [1.0 if i == unit else 0.0 for i in range(units)]
    rows = []
    for t in range(len(sensed)):
        y = [sigmoid(u) for u in path[t]]
        rows.append([y[i] * (1.0 - y[i]) * change[i] for i in range(io)])
        reach = [
            (1.0 - share[t][j] if j < io else 1.0) * y[j] * (1.0 - y[j]) * change[j]
            for j in range(units)
        ]
        change = [
            (1.0 - 1.0 / tau[i]) * change[i]
            + sum(weights[i][j] * reach[j] for j in range(units) if wired(sizes, i, j)) / tau[i]
            for i in range(units)
        ]
    return np.array(rows)


def normal_equations(net, motion, free, units, penalty):
    """Equation (3) with the penalty, and JᵀVJ + p, JᵀVr + pc of some units' initial states."""
    sensed, observed, weight = motion
    sensed = np.where(observed, sensed, 0.0)
    share = shares(observed, 0.0)
    parts = [net[name] for name in ("weights", "bias", "tau", "sizes")]
    begin = start(free, sensed, observed, net["initial_io"])
    path = rollout(*parts, begin, sensed, share)
    io = len(sensed[0])
    columns = []
    for unit in units:
        fixed = unit < io and (net["initial_io"] == "zero" or observed[0][unit])
        rows = sensitivities(*parts, begin, sensed, share, unit)
        columns.append(0.0 * rows if fixed else rows)
    loss, curvature, slope = 0.0, np.zeros((len(units), len(units))), np.zeros(len(units))
    for t in range(1, len(sensed)):
        for d in range(io):
            if observed[t][d]:
                residual = sigmoid(path[t, d]) - sensed[t][d]
                row = np.array([column[t, d] for column in columns])
                loss += weight[t][d] * residual**2
                curvature += weight[t][d] * np.outer(row, row)
                slope += weight[t][d] * residual * row
    prior = np.array([penalty if unit >= io else 0.0 for unit in units])
    sought = np.asarray(free)[list(units)]
    return loss + (prior * sought**2).sum(), curvature + np.diag(prior), slope + prior * sought


def recognition(
    net, motion, free, units, *, iterations, bound, penalty, paces=None, enough=-math.inf
):
    """Take damped steps from one start.

    Returns:
        The initial states, their loss, and the steps that were tried.
    """
    free, units = np.array(free, dtype=float), list(units)
    limit = np.asarray(bound)[units]
    free[units] = np.clip(free[units], -limit, limit)
    loss, curvature, slope = normal_equations(net, motion, free, units, penalty)
    damping, taken = 1e-2, 0
    while taken < iterations and loss > enough:
        stuck = (abs(free[units]) >= limit) & (free[units] * slope < 0)
        moving = np.flatnonzero(~stuck)
        system = curvature[np.ix_(moving, moving)]
        held = np.ones(len(units)) if paces is None else 1.0 / np.asarray(paces)[units] ** 2
        system = system + damping * curvature.diagonal().max() * np.diag(held[moving])
        trial = free.copy()
        for place, change in zip(moving, np.linalg.solve(system, slope[moving]), strict=True):
            trial[units[place]] = np.clip(free[units[place]] - change, -limit[place], limit[place])
        found = normal_equations(net, motion, trial, units, penalty)
        taken += 1
        if found[0] < loss:
            still = loss - found[0] < 1e-4 * loss
            free, damping = trial, 0.2 * damping
            loss, curvature, slope = found
        else:
            damping *= 5.0
            still = damping > 1e4
        if still:
            break
    return np.array(start(free, *motion[:2], net["initial_io"])), loss, taken
