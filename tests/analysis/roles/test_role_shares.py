"""Shares from small tables that can be counted."""

import numpy as np
import pandas as pd
import pytest

from motionese.analysis.roles.order_on_map import order_on_map
from motionese.analysis.roles.recall import strokes_recalled
from motionese.analysis.roles.role_shares import (
    decoded,
    followed,
    read_out,
    right_elements,
    slow_followed,
    spared,
)
from motionese.task import PUSHING_BUTTONS

RUN = ("TD/MD", 3)


def table(columns, *rows):
    """Rows of one run."""
    return pd.DataFrame([(*RUN, *row) for row in rows], columns=["condition", "seed", *columns])


def exchanges(*rows):
    return table(["recognition", "split", "kind", "follows"], *rows)


def test_who_is_followed():
    squares, adam = "least squares", "Adam"
    found = followed(
        exchanges(
            (squares, "cf", "first", "lower"),
            (squares, "cf", "first", "lower"),
            (squares, "cf", "first", "neither"),
            (squares, "cf", "first", "upper"),
            (squares, "cf", "order", "upper"),
            (squares, "cf", "transfer", "lower"),
            (squares, "io", "first", "upper"),
            (adam, "cf", "order", "lower"),
            ("Adam, cf slower", "cf", "first", "lower"),
            ("Adam, cf slower", "cf", "order", "upper"),
        ),
        "cf",
    )
    assert found["first_by_cf"][RUN] == 0.5 and found["first_by_cs"][RUN] == 0.25
    assert found["order_by_cf"][RUN] == 0 and found["order_by_cs"][RUN] == 1
    assert found["separation"][RUN] == 0.5
    assert found["order_by_cf_adam"][RUN] == 1 and np.isnan(found["separation_adam"][RUN])
    assert found["separation_adam_slower"][RUN] == 1


def test_no_exchange_at_all():
    found = followed(exchanges().astype({"seed": int}), "cf")
    assert all(values.empty for values in found.values())


def test_what_lesions_spare():
    columns = ["lesion", "stroke", "ambiguous", "right"]
    found = spared(
        table(
            columns,
            ("none", 1, True, True),
            ("none", 2, True, False),
            ("none", 2, False, True),
            ("cs_0 to its mean", 1, False, True),
            ("cs_0 to its mean", 2, True, False),
            ("cs_0 to its mean", 2, True, True),
            ("cf_0 to its mean", 1, False, False),
            ("cs → cf cut", 3, True, True),
        ),
        "cf",
        "cs",
    )
    assert found["first_intact"][RUN] == 1 and found["branch_intact"][RUN] == 0
    assert found["first_without_cs"][RUN] == 1 and found["branch_without_cs"][RUN] == 0.5
    assert found["first_without_cf"][RUN] == 0 and found["branch_without_cf"].empty
    assert found["branch_cut"][RUN] == 1 and found["first_cut"].empty


def test_what_is_read_out():
    columns = ["level", "reference", "edit_distance", "boundary_error_steps"]
    found = read_out(
        table(
            columns,
            *(("cf", "taught", *row) for row in ((0, 2), (0, 3), (1, 0), (2, np.nan))),
            ("cs", "taught", 3, np.nan),
            ("io", "taught", 3, np.nan),
            ("cf", "alone", 1, np.nan),
        ),
        "cf",
    )
    assert found["symbols_right"][RUN] == 0.5
    assert found["boundaries_right"][RUN] == 0.5, "of those that are read right"
    assert found["symbols_right_alone"][RUN] == 0 and found["boundaries_right_alone"].empty


def test_what_is_decoded_before_motions_part():
    rows = table(
        ["level", "what", "row", "score"],
        ("cf", "direction", np.nan, 0.9),
        ("cs", "direction", np.nan, 0.3),
        ("cs", "position", np.nan, 0.2),
        ("cs", "order", -2, 0.8),
        ("cs", "order", -1, 0.6),
        ("cs", "order", 0, 0.1),
        ("cf", "order", 3, 1.0),
    )
    found = decoded(rows, "cf", "cs")
    assert found["direction_from_cf"][RUN] == 0.9 and found["direction_from_cs"][RUN] == 0.3
    assert found["position_from_cs"][RUN] == 0.2 and found["position_from_cf"].empty
    assert found["order_from_cs"][RUN] == pytest.approx(0.7) and found["order_from_cf"].empty
    unbranched = decoded(rows[rows["what"] != "order"].drop(columns="row"), "cf", "cs")
    assert unbranched["order_from_cs"].empty and unbranched["direction_from_cf"][RUN] == 0.9


def test_what_motions_are_taken_to_begin_with():
    loops = table(
        ["motion", "begins_with_cf"], ("LR ↑←", "LR ↑"), ("LR ↑←", "UR ↓"), ("UR ↓", np.nan)
    )
    assert right_elements(loops, "cf")[RUN] == 0.5
    assert right_elements(loops.drop(columns="begins_with_cf"), "cf").empty


def test_levels_that_are_followed():
    of = pd.DataFrame(
        {
            "condition": ["a", "a", "b", "c"],
            "first_by_cs": [0.0, 0.0, 0.5, np.nan],
            "order_by_cs": [1.0, 0.5, 0.0, np.nan],
        }
    )
    assert slow_followed(of) == ["a", "b"]


STROKES = {"UR ↓": (-np.pi / 2, 0.3), "UR ←": (np.pi, 0.3)}


@pytest.mark.parametrize(
    ("directions", "smallest"),
    [
        ([-1.5, -1.6, 3.1, -3.1], 0.5),
        ([-1.5, -1.6, -1.4, -3.1], 0.25),
        ([3.1, 3.0, -3.0, 3.1], 0.0),
        ([-1.5, 1.5, 0.0, 3.1], 0.25),
    ],
)
def test_order_on_the_map_is_its_smallest_part(directions, smallest):
    points = table(["primitive", "direction_2_rad"], *(("LR ↑", angle) for angle in directions))
    ways = {"TD/MD": {"LR ↑": ("UR ←", "UR ↓")}}
    assert order_on_map(points, ways, STROKES)[RUN] == smallest


def test_a_lesson_without_branches_has_no_order_on_its_map():
    points = table(["primitive", "direction_2_rad"], ("LR ↑", 0.0))
    assert order_on_map(points, {"TD/MD": {}}, STROKES).empty


def test_recall_stroke_by_stroke():
    loops = table(
        ["loop", "phase", "motion", "reproduction_strokes_cm"],
        (1, 1, "UR ↓", 0.5),
        (2, 2, "LR ↑←", "1.00 4.00"),
        (2, 2, "LR ↑↓", "2.00 nan"),
        (2, 2, "UR ↓↑", "3.00 5.00"),
    )
    found = strokes_recalled(loops, PUSHING_BUTTONS)
    assert found["stroke"].to_list() == [1, 1, 2, 1, 2, 1, 2]
    assert found["recall_cm"].to_list() == pytest.approx([0.5, 1, 4, 2, np.nan, 3, 5], nan_ok=True)
    assert found["ambiguous"].to_list() == [False, False, True, False, True, False, False]
    assert found["motion"].to_list()[1:3] == ["LR ↑←"] * 2


def test_what_a_lesson_of_another_stage_has_does_not_make_a_stroke_ambiguous():
    loops = table(
        ["loop", "phase", "motion", "reproduction_strokes_cm"],
        (1, 1, "LR ↑←", "1.00 4.00"),
        (2, 2, "LR ↑↓", "1.00 4.00"),
    )
    assert not strokes_recalled(loops, PUSHING_BUTTONS)["ambiguous"].any()
