"""A text file as columns of cells: which line is at fault, and what in a cell is a number."""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError

SEPARATORS = ",;\t"
COMMENTS = ("#", "%", "sep=")
"""What lines above a table begin with that are no rows of it, or that name its columns."""
MISSING = ("na", "n/a", "null", "none")
"""Words for a value that was not observed, as an empty cell is. NaN is a value."""
TRUTH = {"true": "1", "false": "0"}


@dataclass(frozen=True)
class Table:
    """The cells of a text file, without blanks around them.

    Attributes:
        separator: What stands between two cells; a blank for any number of blanks.
        header: The cells of the first line.
        columns: The cells below, by column.
        lines: The line of the file in which each row ends, counted from 1.
    """

    path: Path
    separator: str
    header: tuple[str, ...]
    columns: tuple[tuple[str, ...], ...]
    lines: tuple[int, ...]

    def where(self, row: int) -> str:
        """Return the file and line of a row, for messages."""
        return f"{self.path}, line {self.lines[row]}"


def read_table(path: Path) -> Table:
    """Read a text file; `RecordingError` where it is none, or a line is wider than its header."""
    text = _text(path)
    lines = io.StringIO(text, newline="").readlines()
    bare = map(str.lstrip, lines)
    above = len(list(takewhile(lambda line: not line or line.startswith(COMMENTS), bare)))
    separator = _separator(lines[above:])
    rows, ends = _rows(path, [*["\n"] * above, *lines[above:]], separator)
    if above and rows:
        # NumPy's savetxt and ROS write the names of the columns as a comment.
        parts = lines[above - 1].lstrip("#% ").split(None if separator == " " else separator)
        named = [part.strip(' "\r\n') for part in parts]
        values = [cell for cell in rows[0] if is_number(cell.replace(",", "."))]
        if values and len(named) == len(rows[0]):
            rows, ends = [named, *rows], [above, *ends]
    # Spreadsheets end a table with lines of nothing but separators.
    while rows and not any(rows[-1]):
        del rows[-1], ends[-1]
    if len(rows) < 2:
        raise RecordingError(
            f"{path}: {'holds no rows below its header' if rows else 'the file is empty'}"
        )
    if len(rows[-1]) < len(rows[0]) and not text.endswith(("\n", "\r")):
        raise RecordingError(
            f"{path}, line {ends[-1]}: the file is cut short inside a row "
            f"({len(rows[-1])} cells, the header has {len(rows[0])})"
        )
    header, *below = (
        _fitted(path, cells, line, len(rows[0])) for cells, line in zip(rows, ends, strict=True)
    )
    return Table(path, separator, tuple(header), tuple(zip(*below, strict=True)), tuple(ends[1:]))


def floats(cells: Sequence[str]) -> Float[ndarray, " T"]:
    """Return cells as numbers, NaN where one is empty; `ValueError` where one is text."""
    return np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)


def is_number(cell: str) -> bool:
    """Tell whether a cell holds a number."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def plain(cell: str, *, decimal_comma: bool) -> str:
    """Return a cell as Python writes its number; empty where nothing was observed."""
    folded = cell.casefold()
    if folded in MISSING:
        return ""
    return TRUTH.get(folded, cell.replace(",", ".") if decimal_comma else cell)


def _text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise RecordingError(
            f"{path}: not a text file in UTF-8 (byte {error.start}); save it as UTF-8"
        ) from error


def _separator(lines: Sequence[str]) -> str:
    first = lines[0] if lines else ""
    if any(mark in first for mark in SEPARATORS):
        return max(SEPARATORS, key=first.count)
    rows = [line for line in lines[:3] if line.strip()]
    # A name may hold blanks; a number does not.
    return " " if len(rows) > 1 and len(rows[1].split()) > 1 else ","


def _rows(path: Path, lines: Sequence[str], separator: str) -> tuple[list[list[str]], list[int]]:
    rows: list[list[str]] = []
    ends: list[int] = []
    reader = csv.reader(lines, delimiter=separator, skipinitialspace=separator == " ", strict=True)
    try:
        for row in reader:
            is_comment = row and rows and len(row) != len(rows[0]) and row[0].startswith(COMMENTS)
            if row and not is_comment:
                rows.append([_one_line(cell) for cell in row])
                ends.append(reader.line_num)
    except csv.Error as error:
        raise RecordingError(f"{path}, line {reader.line_num}: not a csv file: {error}") from error
    return rows, ends


def _fitted(path: Path, cells: list[str], line: int, width: int) -> list[str]:
    """Return as many cells as the header has: what is missing at the end of a row is empty."""
    if any(cells[width:]):
        raise RecordingError(f"{path}, line {line}: {len(cells)} cells, the header has {width}")
    return cells[:width] + [""] * (width - len(cells))


def _one_line(cell: str) -> str:
    """Return a cell without blanks around it, and without the line breaks of spreadsheets."""
    text = cell.strip()
    return " ".join(text.split()) if "\n" in text or "\r" in text else text
