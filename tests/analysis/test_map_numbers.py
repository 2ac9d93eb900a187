"""The map's numbers from tables whose directions are known, and the warnings beside them."""

import numpy as np
import pandas as pd
import pytest
from invented_runs import STUDY, development_table, map_table

from motionese.analysis.directions import true_strokes
from motionese.analysis.map_numbers import map_numbers, warnings
from motionese.body.actroid import Actroid
from motionese.task import PUSHING_BUTTONS

STROKES = true_strokes(PUSHING_BUTTONS, Actroid.eye_position)


def numbers_of(turn, seed=0, condition="TD/MD"):
    points = map_table(condition, seed, np.random.default_rng(0), turn)
    return map_numbers(points, development_table(condition, seed, 5), STUDY, STROKES)


def test_a_uniform_map():
    row = numbers_of(0.0).iloc[0]
    assert row["resultant_length_1"] == pytest.approx(1, abs=1e-3)
    assert row["share_cf_1"] == pytest.approx(1, abs=1e-3)
    assert row["within_45_1"] == 1
    assert (row["rms_cs_to_cf_before"], row["rms_cs_to_cf_after"]) == pytest.approx((2.0, 2.8))


def test_a_turning_map():
    row = numbers_of(6.0).iloc[0]
    assert row["resultant_length_1"] < 0.5
    # Cs_0 turns every primitive's direction by itself: mostly an interaction on the circle.
    assert row["share_cf_1"] < 0.6 and row["share_together_1"] < 0.7
    assert row["within_45_1"] < 0.5
    assert row["resultant_length_2"] < row["resultant_length_1"]


def test_order_of_rows_does_not_matter():
    points = map_table("TD/MD", 3, np.random.default_rng(0), 2.0)
    shuffled = points.sample(frac=1, random_state=1)
    development = development_table("TD/MD", 3, 5)
    pd.testing.assert_frame_equal(
        map_numbers(points, development, STUDY, STROKES),
        map_numbers(shuffled, development, STUDY, STROKES),
    )


def test_no_map_no_numbers():
    empty = pd.DataFrame(columns=["condition", "seed", "primitive", "cs_1", "cs_2"])
    found = map_numbers(empty, development_table("TD/MD", 0, 5), STUDY, STROKES)
    assert found.empty and {"share_cf_2", "rms_cs_to_cf_after"} <= set(found.columns)
    whole = numbers_of(0.0)
    assert set(found.columns) == set(whole.columns)
    assert warnings(found, STUDY) == []


def test_weights_that_no_table_tells_of_are_missing_not_zero():
    points = map_table("TD/MD", 0, np.random.default_rng(0), 1.0)
    development = pd.DataFrame({"condition": ["TD/MD"], "seed": [0], "loop": [1]})
    found = map_numbers(points, development, STUDY, STROKES)
    assert np.isnan(found["rms_cs_to_cf_before"].iloc[0])
    assert warnings(found, STUDY) == []


def test_warnings_tell_an_idle_level_from_one_as_it_was_drawn():
    idle = numbers_of(0.0).assign(rms_cs_to_cf_after=2.1)
    drawn = numbers_of(6.0, condition="TD/MND").assign(rms_cs_to_cf_after=2.1)
    moved = numbers_of(0.0, condition="TND/MND")
    said = warnings(pd.concat([idle, drawn, moved]), STUDY)
    assert len(said) == 2
    assert "does nothing in TD/MD (2.00 → 2.10; 0.0% and 0.0%)" in said[0]
    assert "as it was drawn at random in TD/MND (" in said[1]
    assert "TND/MND" not in "".join(said)


def test_a_level_that_is_followed_has_learned_however_little_its_weights_moved():
    drawn = numbers_of(6.0).assign(rms_cs_to_cf_after=2.1)
    idle = numbers_of(0.0, condition="TND/MD").assign(rms_cs_to_cf_after=2.1)
    said = warnings(pd.concat([drawn, idle]), STUDY, ["TD/MD", "TND/MD"])
    assert len(said) == 1 and "does nothing in TND/MD" in said[0]
