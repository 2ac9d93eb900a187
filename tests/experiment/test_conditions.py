"""Conditions are combinations of choices, known by their names."""

import pytest

from motionese.errors import SettingError
from motionese.experiment import condition_named, conditions_of

FACTORS = {"teaching": ("TD", "TND"), "structuring": ("MD", "MND")}


def test_every_combination_is_a_condition_the_first_factor_changing_slowest():
    conditions = conditions_of(FACTORS)
    assert [c.name for c in conditions] == ["TD/MD", "TD/MND", "TND/MD", "TND/MND"]
    assert all(condition_named(c.name.lower(), FACTORS) == c for c in conditions)
    assert [c.folder for c in conditions] == ["TD-MD", "TD-MND", "TND-MD", "TND-MND"]
    three = conditions_of({"tau": ("slow", "fast", "none")})
    assert [c.name for c in three] == ["slow", "fast", "none"]


def test_an_unknown_condition_is_told_with_the_nearest():
    with pytest.raises(SettingError, match="unknown condition 'TD/MDD'; did you mean 'TD/MD'"):
        condition_named("TD/MDD", FACTORS)
