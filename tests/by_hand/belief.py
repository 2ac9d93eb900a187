"""The forward algorithm over the rows of learned motions, with the whole matrix of transitions."""

import math

import numpy as np

STAYS, LEAPS, CHANGES, ANEW = 0.05, 0.05, 0.05, 0.7


def beliefs(motions, readings, accuracy):
    """How likely every motion is, and none of them, after each reading. [T, motions + 1]

    Args:
        motions: Rows of every motion in the unit interval. [L, D] each
        readings: What is sensed; NaN where nothing is. [T, D]
        accuracy: Standard deviation of a reading from its row.
    """
    states = [(m, r) for m, rows in enumerate(motions) for r in range(len(rows))]
    none, count = len(states), len(states) + 1
    transition = np.zeros((count, count))
    anew = np.append(np.full(none, (1 - CHANGES) / none), CHANGES)
    for i, (m, r) in enumerate(states):
        transition[i] += CHANGES * anew
        goes_on = {r: STAYS, r + 1: 1 - STAYS - LEAPS, r + 2: LEAPS}
        if r == len(motions[m]) - 1:
            goes_on = {r: 1.0}
        for row, share in goes_on.items():
            if row < len(motions[m]):
                transition[i, states.index((m, row))] += (1 - CHANGES) * share
    transition[none] = CHANGES * anew
    transition[none, none] += 1 - CHANGES
    begin = [
        (1 - CHANGES) * ((1 - ANEW) / none + (ANEW / len(motions) if r == 0 else 0.0))
        for _, r in states
    ]
    share, told = np.array([*begin, CHANGES]), []
    for t, reading in enumerate(readings):
        if t:
            share = share @ transition
        for i in range(count):
            for d, value in enumerate(reading):
                if math.isnan(value):
                    continue
                if i == none:
                    share[i] *= 1 / 0.8
                else:
                    away = (motions[states[i][0]][states[i][1]][d] - value) / accuracy
                    share[i] *= math.exp(-(away**2) / 2) / (accuracy * math.sqrt(2 * math.pi))
        share = share / share.sum()
        by_motion = np.zeros(len(motions) + 1)
        for i, value in enumerate(share):
            by_motion[states[i][0] if i < none else -1] += value
        told.append(by_motion)
    return np.array(told)
