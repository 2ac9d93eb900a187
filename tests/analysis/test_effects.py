"""Main effects and interactions, on tables whose effects are known."""

import numpy as np
import pandas as pd
import pytest

from motionese.analysis.effects import effects
from motionese.analysis.seed_measures import Measures

FACTORS = {"teaching": ("TD", "TND"), "structuring": ("MD", "MND")}
NAMES = ["TD/MD", "TD/MND", "TND/MD", "TND/MND"]


def measures(table):
    none = table.iloc[:0]
    return Measures({1: table}, {}, none, none, none, none, none)


def table(values, names=NAMES, seeds=8):
    rng = np.random.default_rng(0)
    noise = 0.01 * rng.standard_normal((seeds, len(names)))
    return pd.DataFrame(np.asarray(values) + noise, columns=names)


def found(of, factors=FACTORS):
    rows = effects(measures(of), factors)
    return dict(zip(rows["effect"], rows["statistic"], strict=True)), rows


def test_effects_are_those_that_were_put_in():
    values, rows = found(table([1.0, 1.0 + 0.4, 1.0 + 2.0, 1.0 + 2.0 + 0.4 - 0.6]))
    assert values["TND − TD"] == pytest.approx(1.7, abs=0.02)
    assert values["MND − MD"] == pytest.approx(0.1, abs=0.02)
    assert values["(TND − TD) × (MND − MD)"] == pytest.approx(-0.3, abs=0.02)
    assert (rows["p"] < 0.05).all() and (rows["seeds"] == 8).all()
    assert ((rows["low"] <= rows["statistic"]) & (rows["statistic"] <= rows["high"])).all()


def test_only_complete_seeds_count_and_a_condition_that_was_not_run_leaves_nothing():
    some = table([1.0, 2.0, 3.0, 4.0])
    some.loc[:2, "TD/MD"] = np.nan
    assert (found(some)[1]["seeds"] == 5).all()
    some["TD/MD"] = np.nan
    assert found(some)[1].empty


def test_one_seed_has_a_value_and_no_test():
    _, rows = found(table([1.0, 2.0, 3.0, 4.0], seeds=1))
    assert rows["p"].isna().all() and rows["statistic"].notna().all()


def test_a_factor_of_three_choices_has_no_main_effect():
    names = [f"{a}/{b}" for a in "xyz" for b in ("MD", "MND")]
    factors = {"pace": ("x", "y", "z"), "structuring": ("MD", "MND")}
    values, _ = found(table([1.0, 2.0, 1.0, 2.0, 1.0, 2.0], names), factors)
    assert list(values) == ["MND − MD"]
    assert values["MND − MD"] == pytest.approx(1.0, abs=0.02)
