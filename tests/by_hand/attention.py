"""Speeds of a seen hand and the weights of rows, value by value."""

import math


def speeds(bearings):
    """Half the way from the row before to the row after; at the ends the end itself stands in."""
    found = []
    for t in range(len(bearings)):
        before, after = bearings[max(t - 1, 0)], bearings[min(t + 1, len(bearings) - 1)]
        right = (after[0] - before[0]) / 2 * math.cos(bearings[t][1])
        up = (after[1] - before[1]) / 2
        found.append(math.sqrt(right * right + up * up))
    return found


def weights(bearings, to, strength, noise):
    """1 + s exp(−(v/v₀)²), or 1 + s (1 − exp(−(v/v₀)²))."""
    found = []
    for speed in speeds(bearings):
        still = math.exp(-(speed / noise) * (speed / noise))
        found.append(1 + strength * (still if to == "rests" else 1 - still))
    return found
