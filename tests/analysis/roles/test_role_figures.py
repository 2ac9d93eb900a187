"""The figures of roles: what is drawn, and that they are drawn of whatever runs there are."""

import numpy as np
import pandas as pd
import pytest
from invented_runs import condition, list_anew, without_map
from matplotlib.colors import to_hex

from motionese.analysis.experiment_data import collect
from motionese.analysis.roles import seed_table
from motionese.analysis.roles.by_construction import by_construction
from motionese.analysis.roles.order_map_figure import order_map
from motionese.analysis.roles.role_figures import role_figures, table_figures
from motionese.analysis.roles.role_table import role_table
from motionese.analysis.roles.seed_points import YOURS
from motionese.analysis.roles.triangle import crowds, place, triangle
from motionese.experiment import read_settings
from motionese.figure_style import INK, finished

FROM_TABLE = ["who_is_followed", "lesions", "symbols"]
ALL = [*FROM_TABLE, "recall", "order_map", "order_decoded"]


@pytest.fixture(scope="module")
def data(orderly):
    return collect(orderly)


@pytest.fixture(scope="module")
def table(data):
    return seed_table(data)


def words(figure):
    """All that is written in the panels of a figure, and in its legends."""
    said = [text.get_text() for axes in figure.axes for text in axes.texts]
    return said + [t.get_text() for legend in figure.legends for t in legend.get_texts()]


def drawn(data, table):
    found = {each.name: each for each in role_figures(data, table)}
    for each in found.values():
        assert each.caption.endswith(".")
        finished(each.figure, each.name)
    return found


def test_all_figures_of_a_lesson_that_asks_for_order(data, table):
    found = drawn(data, table)
    assert list(found) == ALL
    assert "seed of median order over the map: TD/MD" in found["order_map"].caption
    assert "the ways part" in words(found["order_decoded"].figure)
    assert "chance" in words(found["lesions"].figure)
    assert {"TD/MD", "TND/MND", "LR ↑↓", "↑↓"} <= set(words(found["symbols"].figure))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["TD/MD", "TND/MND"])
def test_one_condition_of_one_seed(tmp_path, make_run, name):
    make_run(tmp_path, condition(name), 4, study=read_settings("order"))
    data = collect(tmp_path)
    assert list(drawn(data, seed_table(data))) == ALL


def test_a_lesson_that_asks_for_no_order(tmp_path, make_run):
    make_run(tmp_path, condition("TD/MD"), 0)
    data = collect(tmp_path)
    table = seed_table(data)
    found = drawn(data, table)
    # Invented loops are of all pairs, and therefore of strokes to recall.
    assert list(found) == [*FROM_TABLE, "recall"]
    assert len(found["who_is_followed"].figure.axes) == 1
    assert "chance" not in words(found["lesions"].figure)
    assert not any("order" in row[0] for row in role_table(table, data.looks).rows)


def test_runs_that_were_not_examined(tmp_path, make_run):
    folder = make_run(tmp_path, condition("TD/MD"), 0, study=read_settings("order"))
    without_map(folder)
    make_run(tmp_path, condition("TND/MD"), 0, end="diverged")
    for name in ("exchanges", "lesions", "decoding", "symbols"):
        (folder / f"{name}.csv").write_text("\n")
    list_anew(folder)
    data = collect(tmp_path)
    assert list(drawn(data, seed_table(data))) == ["recall"]


@pytest.mark.slow
def test_your_runs_are_drawn_over_others(data, table):
    yours = table[table["seed"] == 0]
    for each in table_figures(table, data.looks, 0.5, yours):
        finished(each.figure, each.name)
        assert "your runs" in each.caption and YOURS in words(each.figure)
    alone = [each.caption for each in table_figures(table, data.looks, 0.5)]
    assert not any("your runs" in caption for caption in alone)


def test_corners_of_the_triangle():
    for shares in ((1.0, 0.0), (0.0, 1.0), (0.0, 0.0)):
        x, y = place(shares)
        assert (x, y) == pytest.approx({1.0: (0, 0), 0.0: (1, 0)}[shares[0]] if sum(shares) else
                                       (0.5, np.sqrt(0.75)))  # fmt: skip
    assert place((0.5, 0.5)) == pytest.approx([0.5, 0.0])


def test_runs_that_coincide_are_one_point_with_their_number(data):
    many = pd.DataFrame(
        {
            "condition": ["TD/MD"] * 4 + ["TND/MD"],
            "seed": [0, 1, 2, 3, 0],
            "first_by_cf": [1.0, 1.0, 1.0, 0.5, 1.0],
            "first_by_cs": [0.0, 0.0, 0.0, 0.5, 0.0],
            "order_by_cf": np.nan,
            "order_by_cs": np.nan,
        }
    )
    found = list(crowds(many, ["first_by_cf", "first_by_cs"], data.looks))
    assert [tuple(each) for each in found] == [
        ("TD/MD", (0.5, 0.5), 1), ("TD/MD", (1.0, 0.0), 3), ("TND/MD", (1.0, 0.0), 1)
    ]  # fmt: skip
    (axes,) = triangle(many, data.looks).axes
    assert "3" in [text.get_text() for text in axes.texts]
    points = [p.get_offsets()[0] for p in axes.collections]
    apart = [np.linalg.norm(a - b) for i, a in enumerate(points) for b in points[:i]]
    assert min(apart) > 0.01, "conditions that coincide lie beside each other"
    marked = triangle(many, data.looks, many[many["seed"] == 0]).axes[0].collections
    assert sum(to_hex(p.get_edgecolor()[0]) == INK for p in marked) == 2


def test_the_map_is_painted_by_direction_and_divided_by_ways_on():
    side = np.linspace(-5, 5, 4)
    points = pd.DataFrame(
        [
            {"cs_1": x, "cs_2": y, "direction_1_rad": np.pi / 2,
             "direction_2_rad": np.pi if x < 0 else 0.0 if y > 0 else -np.pi / 2}
            for x in side for y in side
        ]
    )  # fmt: skip
    figure = order_map({"TD/MD": points}, "LR ↑", {"UR ←": np.pi, "UR ↓": -np.pi / 2}, ("cf", "cs"))
    first, second = (figure.axes[place].images[0].get_array() for place in (0, 2))
    assert len(np.unique(first.reshape(-1, 4), axis=0)) == 1
    left, below, elsewhere = second[0, 0], second[0, 3], second[3, 3]
    assert elsewhere[3] == 0 and left[3] == below[3] == 1
    assert not np.allclose(left, below) and (second[:, :2] == left).all()
    assert {"←", "↓"} <= set(words(figure))


def test_the_table_of_roles(data, table):
    head, rows = role_table(table, data.looks)
    assert head[1:] == list(data.looks)
    told = {row[0]: row[1:] for row in rows}
    assert told["exchange: order follows Cs₀"][0] == "1.00 [1.00, 1.00]"
    assert told["recall of ambiguous strokes, end of stage 2 [cm]"][0].startswith("0.2")
    assert not any("slow alone" in name for name in told), "what no run has is not told"


def test_what_is_true_by_construction():
    shared, whole = by_construction(read_settings("order"))
    assert "learned states" in shared
    assert whole.startswith("In TD/MND and TND/MND Cf is never the top level")
    (free,) = by_construction(read_settings("free"))
    assert free.startswith("Every motion has initial states of its own")
