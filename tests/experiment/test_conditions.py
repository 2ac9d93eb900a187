"""The 2 × 2 design, and random keys that depend on seed and purpose alone."""

import numpy as np
import pytest

from motionese.errors import SettingError
from motionese.experiment.conditions import CONDITIONS, condition
from motionese.experiment.keys import generator_for, key_for


def test_four_conditions_by_name():
    assert [c.name for c in CONDITIONS] == ["TD/MD", "TD/MND", "TND/MD", "TND/MND"]
    assert all(condition(c.name) is c and condition(c.name.lower()) is c for c in CONDITIONS)
    assert len({c.folder for c in CONDITIONS}) == 4


def test_an_unknown_condition_is_told_with_the_nearest():
    with pytest.raises(SettingError, match="unknown condition 'TD/MDD'; did you mean 'TD/MD'"):
        condition("TD/MDD")


def test_keys_differ_by_seed_and_by_purpose_and_by_nothing_else():
    purposes = [(), ("a",), ("b",), ("a", 1), ("a", 2), (1, "a"), ("a", "b"), ("b", "a")]
    draws = {
        (seed, purpose): generator_for(seed, *purpose).random()
        for seed in (0, 1)
        for purpose in purposes
    }
    assert len(set(draws.values())) == len(draws)
    assert key_for(3, "training", 7) == key_for(3, "training", 7)
    assert np.array_equal(generator_for(3, "x").random(5), generator_for(3, "x").random(5))
