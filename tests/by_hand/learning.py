"""Equations (3)–(5) by plain descent, and recognition: motions one by one, without any padding."""

import math

import numpy as np

from by_hand.gradients import gradients
from by_hand.network import rollout, sigmoid


def start(free, sensed, observed, initial_io):
    """u_0: an IO unit starts from 0, or from the logit of what was sensed if it was."""
    u = list(free)
    for channel in range(len(sensed[0])):
        if initial_io == "zero":
            u[channel] = 0.0
        elif observed[0][channel]:
            u[channel] = math.log(sensed[0][channel] / (1.0 - sensed[0][channel]))
    return u


def shares(observed, teacher_forcing):
    """How much of every input is sensed: all of it in row 0, a share later, none if unobserved."""
    share = np.zeros(np.shape(observed))
    for t in range(len(observed)):
        for channel in range(len(observed[0])):
            if observed[t][channel]:
                share[t, channel] = 1.0 if t == 0 else teacher_forcing
    return share


def error_and_gradients(net, motion, free, teacher_forcing):
    """Equation (3) of one motion, and ∂E of weights, bias and free initial states.

    Args:
        net: Weights, bias, tau, sizes, initial_io by name.
        motion: Sensed values in the unit interval, what was observed, and how much each counts.
        free: Initial states that may be moved. [N]
        teacher_forcing: Share of sensed values in the inputs.
    """
    sensed, observed, weight = motion
    sensed = np.where(observed, sensed, 0.0)
    share = shares(observed, teacher_forcing)
    begin = start(free, sensed, observed, net["initial_io"])
    parts = (net["weights"], net["bias"], net["tau"], net["sizes"])
    path = rollout(*parts, begin, sensed, share)
    error, outer = 0.0, np.zeros(path.shape)
    for t in range(1, len(sensed)):
        for channel in range(len(sensed[0])):
            if observed[t][channel]:
                y = sigmoid(path[t, channel])
                w = weight[t][channel]
                error += w * (y - sensed[t][channel]) ** 2
                outer[t, channel] = 2.0 * w * (y - sensed[t][channel]) * y * (1.0 - y)
    slope = gradients(outer, *parts, begin, sensed, share, path)
    for channel in range(len(sensed[0])):
        if net["initial_io"] == "zero" or observed[0][channel]:
            slope["initial"][channel] = 0.0
    return error, slope


def gaussian_error(net, motion, free, teacher_forcing):
    """Negative log likelihood of one motion, its variance read out of the context units.

    Args as of `error_and_gradients`; `net` holds the read-out as variance_weights, variance_bias.
    """
    sensed, observed, weight = motion
    sensed, io = np.where(observed, sensed, 0.0), len(sensed[0])
    path = rollout(
        *(net[name] for name in ("weights", "bias", "tau", "sizes")),
        start(free, sensed, observed, net["initial_io"]),
        sensed,
        shares(observed, teacher_forcing),
    )
    error = 0.0
    for t in range(1, len(sensed)):
        context = [sigmoid(u) for u in path[t][io:]]
        for channel in range(io):
            read = sum(
                r * y for r, y in zip(net["variance_weights"][channel], context, strict=True)
            )
            variance = math.exp(read + net["variance_bias"][channel]) + 1e-5
            residual = sigmoid(path[t][channel]) - sensed[t][channel]
            cost = residual**2 / (2 * variance) + math.log(math.sqrt(2 * math.pi * variance))
            error += weight[t][channel] * cost if observed[t][channel] else 0.0
    return error


def rate_share(epoch, epochs, schedule):
    """The share of a rate that an epoch is given, counted from 0.

    A cosine schedule rises on a line from a tenth over the first twentieth of the epochs, then
    falls along half a cosine to a hundredth, which the epoch after the last would be given.
    """
    if schedule == "constant":
        return 1.0
    rising = round(epochs / 20)
    if epoch < rising:
        return 0.1 + 0.9 * epoch / rising
    fallen = (1.0 - math.cos(math.pi * (epoch - rising) / (epochs - rising))) / 2.0
    return 1.0 - 0.99 * fallen


def descent(
    net,
    motions,
    free,
    *,
    epochs,
    schedule,
    weight_rate,
    initial_rate,
    teacher_forcing,
    bound,
    clip,
    shared=(),
):
    """Equations (4) and (5), every epoch with the gradients of all motions.

    `shared` lists units and motions [S'] whose initial states of these units are one: it begins
    at their mean, and moves by the mean of their gradients.

    Returns:
        The trained net, the initial states [S, N], and the error of every epoch.
    """
    net, free = dict(net), np.array(free, dtype=float)
    errors = []
    for units, members in shared:
        free[np.ix_(members, units)] = free[np.ix_(members, units)].mean(axis=0)
    for epoch in range(epochs):
        share = rate_share(epoch, epochs, schedule)
        results = [
            error_and_gradients(net, motion, state, teacher_forcing)
            for motion, state in zip(motions, free, strict=True)
        ]
        errors.append(sum(error for error, _ in results))
        d_weights = sum(slope["weights"] for _, slope in results)
        d_bias = sum(slope["bias"] for _, slope in results) * net["learned_bias"]
        d_free = np.array([slope["initial"] for _, slope in results])
        for units, members in shared:
            d_free[np.ix_(members, units)] = d_free[np.ix_(members, units)].mean(axis=0)
        norm = math.sqrt((d_weights**2).sum() + (d_bias**2).sum() + (d_free**2).sum())
        shrink = clip / norm if clip and norm > clip else 1.0
        shrink *= share
        net["weights"] = net["weights"] - weight_rate * shrink * d_weights
        net["bias"] = net["bias"] - weight_rate * shrink * d_bias
        free = np.clip(free - initial_rate * shrink * d_free, -bound, bound)
    return net, free, np.array(errors)


def recognition(net, motion, free, *, iterations, rate, bound, penalty, enough=-math.inf):
    """Descent on the initial states alone, in closed loop; the rate falls to 0.3 after 70 %.

    It ends early where the error has become as small as `enough`.

    Returns:
        The best initial states on the way, their error with the penalty on context states, and
        the iteration at which that was enough, infinite if it never was.
    """
    channels = len(motion[0][0])

    def judged(state):
        error, slope = error_and_gradients(net, motion, state, 0.0)
        context = np.where(np.arange(len(state)) >= channels, state, 0.0)
        return error + penalty * (context**2).sum(), slope["initial"] + 2 * penalty * context

    free = np.clip(np.array(free, dtype=float), -bound, bound)
    best, smallest, arrived = free, math.inf, math.inf
    for iteration in range(iterations + 1):
        loss, slope = judged(free)
        if loss < smallest:
            best, smallest = free, loss
        if loss <= enough:
            arrived = iteration
            break
        slower = 0.3 if iteration >= 0.7 * iterations else 1.0
        free = np.clip(free - rate * slower * slope, -bound, bound)
    return np.array(start(best, *motion[:2], net["initial_io"])), smallest, arrived
