"""Where medians lie beside the kept seeds: by hand, and at the edges."""

import numpy as np
import pandas as pd
import pytest
from invented_results import COLUMNS, measures_table

from motionese.analysis.beside_kept import beside_kept, beside_table


def entry(beside, measure="separation", condition="TD/MD"):
    (found,) = [e for e in beside if (e.measure, e.condition) == (measure, condition)]
    return found


def test_medians_and_the_central_part_of_single_seeds_by_hand():
    kept = measures_table(range(1000, 1041), level=0.0, step=0.025)  # 0 to 1 in equal steps
    own = measures_table(range(3), level=0.97, step=0.01)
    found = entry(beside_kept(kept, own))
    assert (found.kept.value, found.kept.seeds) == (pytest.approx(0.5), 41)
    assert found.kept.low < 0.5 < found.kept.high
    assert found.usual == pytest.approx((0.025, 0.975))
    assert (found.median, found.seeds) == (pytest.approx(0.98), 3)
    assert found.place == "outside"


@pytest.mark.parametrize(
    ("value", "place"),
    [(0.5, "inside"), (1 / 3, "inside"), (0.3333, "outside"), (0.8, "inside"), (0.81, "outside")],
)
def test_an_end_of_the_range_lies_inside_though_kept_numbers_have_six_digits(value, place):
    kept = measures_table(range(2), level=0.333333, step=0.466667)
    kept.loc[kept["seed"] == 1, "separation"] = 0.8
    kept = pd.concat([kept] * 40, ignore_index=True)  # so that the percentiles are the ends
    own = measures_table([0], level=value)
    assert entry(beside_kept(kept, own)).place == place


def test_what_was_not_measured_has_no_place():
    kept = measures_table(range(1000, 1003), without=["order_by_cs"])
    kept = kept[kept["condition"] != "TND/MND"]
    own = measures_table(range(3), without=["order_by_cs", "pressed"])
    own.loc[own["seed"] == 0, "separation"] = np.nan
    beside = beside_kept(kept, own)
    assert "order_by_cs" not in {each.measure for each in beside}
    assert entry(beside).seeds == 2
    missing = entry(beside, "pressed")
    assert (missing.place, missing.seeds) == ("", 0) and np.isnan(missing.median)
    alone = entry(beside, condition="TND/MND")
    assert (alone.place, alone.kept.seeds, alone.seeds) == ("", 0, 2)


def test_without_kept_runs_there_are_medians_alone():
    beside = beside_kept(None, measures_table(range(3)))
    assert {(each.place, each.kept.seeds) for each in beside} == {("", 0)}
    assert len(beside) == 4 * len(COLUMNS)
    assert beside_kept(None, measures_table(range(3)).iloc[:0]) == []


def test_the_table_says_the_same():
    beside = beside_kept(measures_table(range(9)), measures_table(range(2)))
    table = beside_table(beside)
    first, row = beside[0], table.iloc[0]
    assert (row["measure"], row["kept_low"], row["usual_high"], row["seeds"]) == (
        *(first.measure, first.kept.low, first.usual[1], 2),
    )
    assert len(table) == len(beside) and list(beside_table([]).columns) == list(table.columns)
