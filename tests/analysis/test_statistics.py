"""Statistics over seeds against what can be counted or derived by hand."""

import itertools
import math

import numpy as np
import pytest
from by_hand.holm import closed_bonferroni
from hypothesis import given
from hypothesis import strategies as st

from motionese.analysis.statistics import check_seeds, contrast, estimate, holm, verdict
from motionese.errors import TooFewSeedsError


def by_counting(differences):
    """The two-sided p of the sign-flip test, all flips enumerated."""
    means = [
        np.mean(np.multiply(signs, differences))
        for signs in itertools.product([1, -1], repeat=len(differences))
    ]
    mean = np.mean(differences)
    above = np.mean([m >= mean - 1e-12 for m in means])
    below = np.mean([m <= mean + 1e-12 for m in means])
    return min(1.0, 2 * min(above, below))


@given(st.lists(st.floats(-5, 5).map(lambda x: round(x, 3)), min_size=2, max_size=8))
def test_the_paired_test_is_exact(differences):
    found = contrast(np.array(differences), "anything")
    assert found.p == pytest.approx(by_counting(differences), abs=1e-12)
    assert found.seeds == len(differences)
    assert found.low <= found.value + 1e-12 and found.high >= found.value - 1e-12


@pytest.mark.parametrize(("seeds", "p"), [(3, 0.25), (5, 0.0625), (6, 0.03125), (8, 2 / 256)])
def test_least_p_of_so_many_seeds(seeds, p):
    assert contrast(np.linspace(1, 2, seeds), "anything").p == pytest.approx(p)


def test_many_seeds_are_flipped_at_random_but_repeatably():
    differences = np.random.default_rng(0).normal(0.5, 1, 30)
    first, second = (contrast(differences, "anything") for _ in range(2))
    assert first == second
    assert 0 < first.p < 0.05


def test_effect_is_cohens_d_of_paired_differences():
    differences = np.array([1.0, 2.0, 3.0, 6.0])
    assert contrast(differences, "").effect == pytest.approx(3.0 / math.sqrt(14 / 3))
    assert contrast(-differences, "").effect == pytest.approx(-3.0 / math.sqrt(14 / 3))
    assert contrast(np.zeros(4), "").effect == 0.0
    assert contrast(np.ones(4), "").effect == math.inf


def test_interval_of_the_mean_covers_as_often_as_it_says():
    rng = np.random.default_rng(1)
    intervals = [estimate(rng.normal(3.0, 1.0, 25), np.mean) for _ in range(300)]
    covered = np.mean([e.low <= 3.0 <= e.high for e in intervals])
    assert 0.88 <= covered <= 0.98
    # The normal interval of 25 values is 2 · 1.96 / 5 wide.
    assert np.mean([e.high - e.low for e in intervals]) == pytest.approx(0.78, abs=0.06)


def test_interval_of_the_median():
    found = estimate(np.array([1.0, 2.0, 9.0]))
    assert (found.value, found.low, found.high, found.seeds) == (2.0, 1.0, 9.0, 3)


def test_estimates_leave_out_what_is_missing():
    found = estimate(np.array([1.0, math.nan, 3.0]))
    assert (found.value, found.seeds) == (2.0, 2)
    one = estimate(np.array([4.0, math.nan]))
    assert (one.value, one.seeds) == (4.0, 1)
    assert math.isnan(one.low) and math.isnan(one.high)
    none = estimate(np.array([math.nan]))
    assert math.isnan(none.value) and none.seeds == 0


def test_equal_values_have_an_interval_of_no_width():
    found = estimate(np.full(5, 2.5))
    assert (found.value, found.low, found.high) == (2.5, 2.5, 2.5)


def test_verdicts():
    clear = np.array([1.0, 1.2, 0.8, 1.1, 0.9, 1.3])
    assert verdict(contrast(clear, "")) == "holds"
    assert verdict(contrast(-clear, "")) == "does not hold"
    assert verdict(contrast(clear[:5], "")) == "undecided with 5 seeds"
    mixed = np.array([1.0, -1.2, 0.8, -1.1, 0.9, -0.3])
    assert verdict(contrast(mixed, "")) == "undecided with 6 seeds"
    assert verdict(None, 1) == "undecided with 1 seed"
    assert verdict(None) == "undecided with 0 seeds"


@pytest.mark.parametrize("seeds", [0, 1])
def test_too_few_seeds(seeds):
    with pytest.raises(TooFewSeedsError, match=rf"at least 2 of them; TD − TND: got {seeds}$"):
        contrast(np.ones(seeds), "TD − TND")
    with pytest.raises(TooFewSeedsError, match="got"):
        check_seeds(seeds, "anything")


@given(st.lists(st.floats(0, 1), max_size=6))
def test_holm_is_the_closure_of_bonferroni(p_values):
    assert holm(p_values) == pytest.approx(closed_bonferroni(p_values))


def test_holm_known_values():
    # R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm")
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])
    assert holm([0.2]) == [0.2] and holm([]) == []


def test_holm_counts_tests_that_could_not_be_made():
    one, none, other = holm([0.01, math.nan, 0.02])
    assert (one, other) == pytest.approx((0.03, 0.04)) and math.isnan(none)
