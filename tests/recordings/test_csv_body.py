"""The fast way of reading rows reads what the careful way reads, or nothing."""

import io
from unittest import mock

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from motionese.errors import MotioneseError
from motionese.recordings import read
from motionese.recordings.formats import csv_body, csv_table

CELLS = st.one_of(
    st.sampled_from(["", "0", "-0", "007", "1e5", "+1", ".5", "1.", "nan", "-inf", "null", "NA"]),
    st.sampled_from(["true", " 3 ", "1_0", "0x1", "[1]", "1],[2", "{}", '"4"', '""', "a", "1e999"]),
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


def check_both_ways(path, rows, ending, separator, ended):
    text = ending.join(separator.join(row) for row in [["x", "y", "z"], *rows])
    path.write_bytes((text + ending * ended).encode())
    fast = recorded(path)
    with mock.patch.object(csv_table, "read_body", lambda *_: None):
        careful = recorded(path)

    np.testing.assert_equal(fast, careful)


@settings(max_examples=60)
@BODIES
@example([["1", "2", ""], ["3"]], "\n", ",", True)
@example([["1", ""], ["", "2"]], "\n", ",", False)
@example([["", "", "true", "0"], ["", "", ""]], "\n", ",", False)
def test_both_ways_agree(tmp_path, rows, ending, separator, ended):
    check_both_ways(tmp_path / "table.csv", rows, ending, separator, ended)


@pytest.mark.slow
@settings(max_examples=2000)
@BODIES
def test_both_ways_agree_throughout(tmp_path, rows, ending, separator, ended):
    check_both_ways(tmp_path / "table.csv", rows, ending, separator, ended)


def test_rows_are_read_in_pieces():
    rows = np.random.default_rng(0).normal(size=(500, 7))
    content = "\n".join(",".join(map(repr, row)) for row in rows.tolist()).encode()
    with mock.patch.object(csv_body, "CHUNK", 100):
        values, seen, _ = csv_body.read_body(io.BytesIO(content), ",", 7, [])

    np.testing.assert_array_equal(values, rows)
    assert seen.all()


@pytest.mark.parametrize("content", [b"1,2\n3", b'"1",2\n', b"1;2\n", b"1,2\r3,4\n", b"1,x\n", b""])
def test_what_is_not_plain_is_not_read(content):
    assert csv_body.read_body(io.BytesIO(content), ",", 2, []) is None
