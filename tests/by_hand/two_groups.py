"""Two groups compared by counting: Cliff's delta over pairs, the rank test over all partitions."""

from itertools import combinations

import numpy as np


def cliffs_delta(one, other):
    """Return the share of pairs in which the first is larger, minus that in which it is smaller."""
    pairs = [(a > b) - (a < b) for a in one for b in other]
    return sum(pairs) / len(pairs)


def rank_test(one, other):
    """Return the two-sided p: twice the smaller tail of the deltas of all partitions."""
    together = [*one, *other]
    deltas = []
    for members in combinations(range(len(together)), len(one)):
        rest = [i for i in range(len(together)) if i not in members]
        deltas.append(cliffs_delta([together[i] for i in members], [together[i] for i in rest]))
    seen = cliffs_delta(one, other)
    tails = np.mean(np.array(deltas) >= seen - 1e-9), np.mean(np.array(deltas) <= seen + 1e-9)
    return min(1.0, 2 * min(tails))
