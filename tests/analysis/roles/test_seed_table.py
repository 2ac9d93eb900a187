"""The measures of every run in one table."""

import pandas as pd
import pytest
from invented_runs import STUDY, condition, list_anew, without_map

from motionese.analysis.experiment_data import collect
from motionese.analysis.roles import seed_table

COLUMNS = """
    condition seed loop_1_cm end_of_stage_1_cm end_of_stage_2_cm pressed trained_cm untrained_cm
    untrained_spread_cm untrained_repertoire_cm untrained_slow_alone_cm map_length_1 map_length_2
    own_direction order_on_map first_by_cf first_by_cs order_by_cf order_by_cs separation
    first_by_cf_adam first_by_cs_adam order_by_cf_adam order_by_cs_adam separation_adam
    first_by_cf_adam_slower first_by_cs_adam_slower order_by_cf_adam_slower
    order_by_cs_adam_slower separation_adam_slower first_intact first_without_cf first_without_cs
    first_cut branch_intact branch_without_cf branch_without_cs branch_cut symbols_right
    boundaries_right symbols_right_alone boundaries_right_alone recall_ambiguous_1_cm
    recall_other_1_cm recall_ambiguous_2_cm recall_other_2_cm right_elements direction_from_cf
    direction_from_cs position_from_cf position_from_cs order_from_cf order_from_cs
"""


@pytest.fixture(scope="module")
def table(orderly):
    return seed_table(collect(orderly)).set_index(["condition", "seed"])


def test_every_measure_has_a_column_and_every_run_a_row(table):
    assert [*table.index.names, *table.columns] == COLUMNS.split()
    names = [each.name for each in STUDY.conditions]
    assert table.index.to_list() == [(name, seed) for name in names for seed in range(3)]


def test_measures_tell_the_conditions_apart(table):
    middle = table.groupby("condition").mean()
    assert middle["separation"].to_dict() == {
        "TD/MD": 1.0, "TD/MND": 0.0, "TND/MD": 0.0, "TND/MND": 0.0
    }  # fmt: skip
    assert middle.loc["TD/MD", "branch_without_cs"] < 1 == middle.loc["TD/MD", "branch_without_cf"]
    assert middle.loc["TND/MD", "branch_without_cf"] < 1 == middle.loc["TND/MD", "branch_cut"]
    assert middle.loc["TD/MD", "order_from_cs"] > 0.9 > middle.loc["TD/MD", "order_from_cf"]


def test_errors_of_imitation(table, orderly):
    data = collect(orderly)
    new = data.new_sequences.query("condition == 'TD/MND' and seed == 1 and not trained")
    row = table.loc["TD/MND", 1]
    error = new["imitation_error_cm"]
    assert row["untrained_cm"] == pytest.approx(error.mean())
    assert row["untrained_spread_cm"] == pytest.approx(error.std(ddof=1))
    assert row["untrained_repertoire_cm"] == pytest.approx(1.5 * error.mean())
    own = data.loops.query("condition == 'TD/MND' and seed == 1")
    last = own.query("loop in (2, 3, 4)").groupby("loop")["imitation_error_cm"].mean().mean()
    assert row["end_of_stage_1_cm"] == pytest.approx(last)
    assert row["loop_1_cm"] == pytest.approx(own.query("loop == 1")["imitation_error_cm"].mean())
    assert row["pressed"] == 1.0


def test_recall_at_the_ends_of_stages(table):
    # Stage 1 is of primitives; strokes are recalled with a fifth of the imitation error.
    row = table.loc["TD/MD", 0]
    assert pd.isna(row["recall_ambiguous_1_cm"])
    assert row["recall_other_1_cm"] == pytest.approx(0.2 * row["end_of_stage_1_cm"], abs=0.02)
    assert row["recall_ambiguous_2_cm"] == pytest.approx(0.2 * row["end_of_stage_2_cm"], abs=0.02)


def test_errors_with_only_the_slow_level_sought(tmp_path, make_run):
    path = make_run(tmp_path, condition("TD/MD"), 0) / "triples.csv"
    pd.read_csv(path).assign(slow_alone_imitation_error_cm=7.0).to_csv(path, index=False)
    list_anew(path.parent)
    assert seed_table(collect(tmp_path))["untrained_slow_alone_cm"].to_list() == [7.0]


def test_runs_that_did_not_come_to_their_end(tmp_path, make_run):
    make_run(tmp_path, condition("TD/MD"), 0, end="diverged")
    make_run(tmp_path, condition("TD/MD"), 1, end="unfinished")
    table = seed_table(collect(tmp_path))
    assert table["seed"].to_list() == [0]
    measured = table.drop(columns=["condition", "seed"]).notna().iloc[0]
    assert set(measured.index[measured]) == {
        "loop_1_cm", "end_of_stage_1_cm", "end_of_stage_2_cm", "pressed", "recall_other_1_cm"
    }  # fmt: skip


def test_a_lesson_that_asks_for_no_order(tmp_path, make_run):
    without_map(make_run(tmp_path, condition("TD/MD"), 0))
    row = seed_table(collect(tmp_path)).iloc[0]
    assert row[["first_by_cf", "first_intact", "symbols_right"]].notna().all()
    none = ["order_by_cs", "separation", "branch_intact", "order_on_map", "order_from_cs"]
    assert row[[*none, "map_length_1"]].isna().all()
