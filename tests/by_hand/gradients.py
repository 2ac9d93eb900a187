"""Back-propagation through time, unrolled: every gradient of a rollout, one motion at a time."""

import numpy as np

from by_hand.network import inputs, sigmoid, summed_input, wired


def gradients(outer, weights, bias, tau, sizes, initial, sensed, share, path):
    """Carry ∂E/∂u_t, given for every t as if later steps did not depend on it, back to all causes.

    Args:
        outer: ∂E/∂u_t by E's own formula. [T, N]
        path: The potentials of the rollout. [T, N]

    Returns:
        ∂E by name: weights, bias, tau, initial, sensed, share, noise.
    """
    units, channels = len(initial), len(sensed[0])
    total = np.array(outer, dtype=float)
    d_weights, d_bias, d_tau = np.zeros((units, units)), np.zeros(units), np.zeros(units)
    d_sensed, d_share = np.zeros(np.shape(sensed)), np.zeros(np.shape(share))
    for t in range(len(path) - 1, 0, -1):
        x = inputs(path[t - 1], sensed[t - 1], share[t - 1])
        d_x = np.zeros(units)
        for i in range(units):
            caused = total[t, i] / tau[i]
            total[t - 1, i] += (1.0 - 1.0 / tau[i]) * total[t, i]
            d_bias[i] += caused
            drift = summed_input(i, x, weights, bias, sizes) - path[t - 1][i]
            d_tau[i] -= caused / tau[i] * drift
            for j in range(units):
                if wired(sizes, i, j):
                    d_weights[i, j] += caused * x[j]
                    d_x[j] += caused * weights[i][j]
        for j in range(units):
            y = sigmoid(path[t - 1][j])
            own = 1.0
            if j < channels:
                own = 1.0 - share[t - 1][j]
                d_sensed[t - 1, j] += share[t - 1][j] * d_x[j]
                d_share[t - 1, j] += (sensed[t - 1][j] - y) * d_x[j]
            total[t - 1, j] += own * d_x[j] * y * (1.0 - y)
    noise = total.copy()
    noise[0] = 0.0
    return {
        "weights": d_weights,
        "bias": d_bias,
        "tau": d_tau,
        "initial": total[0],
        "sensed": d_sensed,
        "share": d_share,
        "noise": noise,
    }
