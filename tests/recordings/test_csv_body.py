"""The fast ways of reading rows read what the careful way reads, or nothing."""

import io
import sys
from unittest import mock

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from motionese.errors import MotioneseError
from motionese.recordings import read
from motionese.recordings.formats import csv_arrow, csv_body, csv_table

FAST = (csv_arrow.read_large_body, csv_body.read_body)

CELLS = st.one_of(
    st.sampled_from(["", "0", "-0", "007", "1e5", "+1", ".5", "1.", "nan", "-inf", "null", "NA"]),
    st.sampled_from(["true", " 3 ", "1_0", "0x1", "[1]", "1],[2", "{}", '"4"', '""', "a", "1e999"]),
    st.sampled_from(
        ["nan(1)", "-nan", "5e-324", "2e-324", "Infinity", "#1", "1,5", "\t2", "é", " "]
    ),
    st.floats(allow_nan=False).map(repr),
    st.integers().map(str),
)


def recorded(path):
    try:
        found = read(path)
    except MotioneseError as error:
        return str(error)
    return found.channels, found.findings, [(e.name, e.values, e.observed) for e in found.episodes]


BODIES = given(
    st.lists(st.lists(CELLS, min_size=2, max_size=4), min_size=1, max_size=5),
    st.sampled_from(["\n", "\r\n", "\n\n"]),
    st.sampled_from([",", ";", "\t", " "]),
    st.booleans(),
)


def check_all_ways(path, rows, ending, separator, ended):
    text = ending.join(separator.join(row) for row in [["x", "y", "z"], *rows])
    path.write_bytes((text + ending * ended).encode())
    with mock.patch.object(csv_table, "read_body", lambda *_: None):
        careful = recorded(path)
        with mock.patch.object(csv_table, "LARGE", -1):
            arrow = recorded(path)

    np.testing.assert_equal(recorded(path), careful)
    np.testing.assert_equal(arrow, careful)


@settings(max_examples=60)
@BODIES
@example([["1", "2", ""], ["3"]], "\n", ",", True)
@example([["1", ""], ["", "2"]], "\n", ",", False)
@example([["", "", "true", "0"], ["", "", ""]], "\n", ",", False)
@example([["1", "2", "3"], ["4", "nan(1)", "5"]], "\n", ",", False)
@example([["1", "2", "3"], ["", "", ""], ["4", "5", "6"]], "\n", ",", True)
@example([["1", "2", "3"], [], ["4", "5", "6"]], "\n", ";", True)
@example([["1", "2", "3"], ["", "4", "5"]], "\n", " ", True)
@example([["1", "a", "2"], ["3", "", "4"]], "\n", ",", True)
@example([["1", '"a"', "2"], ["3", "b", "4"]], "\n", ",", True)
def test_all_ways_agree(tmp_path, rows, ending, separator, ended):
    check_all_ways(tmp_path / "table.csv", rows, ending, separator, ended)


@pytest.mark.slow
@settings(max_examples=2000)
@BODIES
def test_all_ways_agree_throughout(tmp_path, rows, ending, separator, ended):
    check_all_ways(tmp_path / "table.csv", rows, ending, separator, ended)


@pytest.mark.parametrize("read_fast", FAST)
def test_rows_are_read_in_pieces(read_fast):
    rows = np.random.default_rng(0).normal(size=(500, 7))
    content = "\n".join(",".join(["a", *map(repr, row)]) for row in rows.tolist()).encode()
    with mock.patch.object(csv_body, "CHUNK", 300), mock.patch.object(csv_arrow, "BLOCK", 300):
        values, seen, words = read_fast(io.BytesIO(content), ",", 8, [0])

    np.testing.assert_array_equal(values, rows)
    assert seen.all()
    assert words == (("a",) * 500,)


@pytest.mark.parametrize("read_fast", FAST)
@pytest.mark.parametrize("content", [b"1,2\n3", b'"1",2\n', b"1;2\n", b"1,2\r3\n", b"1,x\n", b""])
def test_what_is_not_plain_is_not_read(read_fast, content):
    assert read_fast(io.BytesIO(content), ",", 2, []) is None


@pytest.mark.parametrize("read_fast", FAST)
def test_empty_cells_are_not_observed(read_fast):
    values, seen, _ = read_fast(io.BytesIO(b"1,\n,2\n,\n"), ",", 2, [])

    np.testing.assert_array_equal(values, [[1, np.nan], [np.nan, 2]])
    np.testing.assert_array_equal(seen, [[True, False], [False, True]])


def test_a_large_table_is_read_without_arrow(tmp_path, monkeypatch):
    path = tmp_path / "large.csv"
    path.write_text("x,y\n" + "0.5,-1.25\n" * 9)
    monkeypatch.setattr(csv_table, "LARGE", 0)
    with mock.patch.dict(sys.modules, {"pyarrow": None}):
        found = read(path)

    np.testing.assert_array_equal(found.episodes[0].values, [[0.5, -1.25]] * 9)
