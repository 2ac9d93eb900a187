"""Holm's correction by the closure principle: a test counts if all sets it is in would, Bonferroni.

The step-down procedure is a short cut through these sets (Marcus, Peritz and Gabriel, Biometrika
63, 1976).
"""

from collections.abc import Sequence
from itertools import combinations


def closed_bonferroni(p_values: Sequence[float]) -> list[float]:
    """Return p values corrected by testing every set of hypotheses."""
    tests = range(len(p_values))
    corrected = [0.0] * len(p_values)
    for size in range(1, len(p_values) + 1):
        for members in combinations(tests, size):
            of_set = min(1.0, size * min(p_values[i] for i in members))
            for i in members:
                corrected[i] = max(corrected[i], of_set)
    return corrected
