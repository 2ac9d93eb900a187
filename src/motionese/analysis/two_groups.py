"""Two groups of observations that are not paired: difference, interval, rank test, effect size."""

from math import nan
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from scipy import stats

from motionese.analysis.statistics import FEWEST, RESAMPLES, SEED, Estimate, bootstrapped, estimate


class Difference(NamedTuple):
    """What two groups say; NaN where one has fewer than two observations.

    Attributes:
        one, other: The means of the groups with their intervals.
        value: The first group's mean minus the second's; `low` and `high` are the ends of its
            95 % percentile bootstrap interval, both groups resampled.
        effect: Cliff's delta (N. Cliff, Psychological Bulletin 114, 1993): how much likelier an
            observation of the first group is larger than one of the second than smaller, −1 to 1.
        p: Two-sided, of the permutation test of ranks (H. B. Mann and D. R. Whitney, Annals of
            Mathematical Statistics 18, 1947), exact where there are at most 4999 ways to part the
            observations.
    """

    one: Estimate
    other: Estimate
    value: float
    low: float
    high: float
    effect: float
    p: float


def difference(one: Float[ndarray, " n"], other: Float[ndarray, " m"]) -> Difference:
    """Compare two groups of observations; NaN observations are left out."""
    a, b = one[np.isfinite(one)], other[np.isfinite(other)]
    mean_a, mean_b = estimate(a, np.mean), estimate(b, np.mean)
    value = mean_a.value - mean_b.value
    if min(len(a), len(b)) < FEWEST:
        return Difference(mean_a, mean_b, value, nan, nan, nan, nan)
    low, high = bootstrapped((a, b), _apart)
    permuted = stats.PermutationMethod(n_resamples=RESAMPLES, rng=np.random.default_rng(SEED))
    test = stats.mannwhitneyu(a, b, method=permuted)
    effect = 2 * float(test.statistic) / (len(a) * len(b)) - 1
    return Difference(mean_a, mean_b, value, low, high, effect, float(test.pvalue))


def _apart(one: Any, other: Any, axis: int) -> Any:
    return np.mean(one, axis=axis) - np.mean(other, axis=axis)
