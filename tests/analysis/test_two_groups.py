"""Two groups against what can be counted."""

import math

import numpy as np
import pytest
from by_hand.two_groups import cliffs_delta, rank_test
from hypothesis import given
from hypothesis import strategies as st

from motionese.analysis.two_groups import difference

values = st.lists(st.integers(-4, 4).map(float), min_size=2, max_size=5)


@given(values, values)
def test_effect_and_test_are_those_counted_ties_included(one, other):
    found = difference(np.array(one), np.array(other))
    assert found.effect == pytest.approx(cliffs_delta(one, other))
    assert found.p == pytest.approx(rank_test(one, other))
    assert found.value == pytest.approx(np.mean(one) - np.mean(other))
    assert found.low <= found.value + 1e-9 and found.high >= found.value - 1e-9


def test_groups_that_are_apart():
    found = difference(np.arange(5.0) + 10, np.arange(4.0))
    assert found.effect == 1.0 and found.p == pytest.approx(2 / math.comb(9, 4))
    assert found.low > 0
    swapped = difference(np.arange(4.0), np.arange(5.0) + 10)
    assert (swapped.effect, swapped.p, swapped.value) == (-1.0, found.p, -found.value)


@pytest.mark.slow
def test_the_interval_covers_as_often_as_it_says():
    rng = np.random.default_rng(1)
    found = [difference(rng.normal(2, 1, 20), rng.normal(1, 2, 25)) for _ in range(40)]
    assert 0.85 <= np.mean([d.low <= 1.0 <= d.high for d in found]) <= 1.0
    assert difference(np.arange(20.0), np.arange(25.0)) == difference(
        np.arange(20.0), np.arange(25.0)
    )


def test_what_is_missing_is_left_out():
    found = difference(np.array([1.0, math.nan, 3.0]), np.array([0.0, 1.0]))
    assert (found.one.value, found.one.seeds, found.other.seeds) == (2.0, 2, 2)
    one = difference(np.array([1.0, math.nan]), np.array([0.0, 1.0]))
    assert one.value == 0.5 and math.isnan(one.p) and math.isnan(one.low) and math.isnan(one.effect)
    none = difference(np.array([math.nan]), np.array([0.0, 1.0]))
    assert math.isnan(none.value)
