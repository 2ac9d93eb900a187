"""Statistics over seeds: intervals, paired tests, effect sizes, and verdicts computed from them.

The unit is the seed: conditions of the same seed have the same demonstrations and, in the levels
they share, the same initial weights, so they are compared in pairs. Everything resampled is
resampled from a fixed generator: the same data give the same numbers.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray
from scipy import stats

from motionese.errors import TooFewSeedsError

LEVEL = 0.05
"""A test with p of at most this decides, and intervals cover 1 − this."""
RESAMPLES = 4999
SEED = 20130
DECIDING = 6
"""Seeds below which no sign-flip test can reach p ≤ 0.05."""
FEWEST = 2
"""Seeds below which there is neither an interval nor a test."""


class Estimate(NamedTuple):
    """A statistic over seeds with its bootstrap interval; NaN bounds where one seed is all."""

    value: float
    low: float
    high: float
    seeds: int


class Contrast(NamedTuple):
    """What paired differences say; differences are signed so that positive speaks for a claim.

    Attributes:
        value: Their mean; `low` and `high` are the ends of its 95 % interval.
        p: Two-sided, of the sign-flip permutation test.
        effect: Cohen's d of paired differences, mean / standard deviation.
    """

    value: float
    low: float
    high: float
    p: float
    effect: float
    seeds: int


def estimate(values: Float[ndarray, " n"], statistic: Callable[..., Any] = np.median) -> Estimate:
    """Return a statistic with its 95 % percentile bootstrap interval; NaN values are left out."""
    kept = values[np.isfinite(values)]
    if not len(kept):
        return Estimate(math.nan, math.nan, math.nan, 0)
    value = float(statistic(kept))
    if len(kept) < FEWEST:
        return Estimate(value, math.nan, math.nan, len(kept))
    low, high = bootstrapped((kept,), statistic)
    return Estimate(value, low, high, len(kept))


def bootstrapped(samples: Sequence[Any], statistic: Callable[..., Any]) -> tuple[float, float]:
    """Return the bootstrap interval of a statistic of samples that are drawn apart.

    Percentile rather than BCa: with few or equal values BCa has no acceleration to estimate.
    """
    interval = stats.bootstrap(
        tuple(samples),
        statistic,
        n_resamples=RESAMPLES,
        confidence_level=1 - LEVEL,
        method="percentile",
        rng=np.random.default_rng(SEED),
    ).confidence_interval
    return float(interval.low), float(interval.high)


def contrast(differences: Float[ndarray, " n"], what: str) -> Contrast:
    """Test whether paired differences are other than 0 on average.

    The sign-flip permutation test assumes only that under no effect a difference is as likely as
    its negative; it is exact up to twelve seeds. Fewer than six seeds cannot reach p ≤ 0.05;
    fewer than two are a `TooFewSeedsError`, whose sentence says `what` is compared.
    """
    check_seeds(len(differences), what)
    mean = estimate(differences, np.mean)
    test = stats.permutation_test(
        (differences,),
        np.mean,
        permutation_type="samples",
        n_resamples=RESAMPLES,
        rng=np.random.default_rng(SEED),
    )
    spread, effect = float(differences.std(ddof=1)), 0.0
    if mean.value:
        effect = mean.value / spread if spread else math.copysign(math.inf, mean.value)
    return Contrast(mean.value, mean.low, mean.high, float(test.pvalue), effect, mean.seeds)


def holm(p_values: Sequence[float]) -> list[float]:
    """Return p values corrected for their number by Holm's step-down procedure.

    With p_(1) ≤ … ≤ p_(m), the corrected p_(k) is the largest of (m − j + 1) p_(j), j ≤ k, and at
    most 1: all of at most α are rejected with a family-wise error of at most α, whichever depend on
    each other (S. Holm, Scand. J. Statist. 6, 1979). A test that could not be made (NaN) counts as
    one that rejects nothing, and stays NaN.
    """
    p = np.asarray(p_values, dtype=np.float64)
    order = np.argsort(p)  # NaN last
    stepped = np.maximum.accumulate(p[order] * np.arange(len(p), 0, -1))
    corrected = np.empty_like(p)
    corrected[order] = np.minimum(stepped, 1.0)
    return [float(each) for each in corrected]


def check_seeds(seeds: int, what: str) -> None:
    """Raise `TooFewSeedsError` where there are too few seeds for a test."""
    if seeds < FEWEST:
        raise TooFewSeedsError(
            f"a test over seeds needs at least {FEWEST} of them; {what}: got {seeds}"
        )


def verdict(tested: Contrast | None, seeds: int = 0, parts: int = 1) -> str:
    """Return "holds", "does not hold", or "undecided with n seeds".

    A claim is decided only where the interval leaves out 0 and the test agrees.

    Args:
        tested: The contrast; None with fewer seeds than a test needs, which are then `seeds`.
        parts: How many contrasts the claim has, any of which may speak against it.
    """
    if tested is not None:
        if tested.low > 0 and tested.p <= LEVEL:
            return "holds"
        if tested.high < 0 and tested.p <= LEVEL / parts:
            return "does not hold"
    count = tested.seeds if tested is not None else seeds
    return f"undecided with {count} seed{'' if count == 1 else 's'}"
