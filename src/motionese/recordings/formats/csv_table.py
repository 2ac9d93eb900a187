"""A text file as columns of cells, and columns of cells as numbers; which line is at fault."""

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError

SEPARATORS = ",;\t"


@dataclass(frozen=True)
class Table:
    """The cells of a text file, without blanks around them.

    Attributes:
        path: The file, for messages.
        separator: What stands between two cells.
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

    def filled(self, column: int) -> Bool[ndarray, " T"]:
        """Return which cells of a column are not empty."""
        return np.array([bool(cell) for cell in self.columns[column]], dtype=bool)


def read_table(path: Path) -> Table:
    """Read a text file; `RecordingError` where it is none, or its lines differ in width."""
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise RecordingError(
            f"{path}: not a text file in UTF-8 (byte {error.start}); save it as UTF-8"
        ) from error
    first = text.lstrip("\r\n").partition("\n")[0]
    separator = max(SEPARATORS, key=first.count)
    rows, lines = [], []
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    try:
        for row in reader:
            if row:
                rows.append([_one_line(cell) for cell in row])
                lines.append(reader.line_num)
    except csv.Error as error:
        raise RecordingError(f"{path}, line {reader.line_num}: not a csv file: {error}") from error
    # Spreadsheets end a table with lines of nothing but separators.
    while rows and not any(rows[-1]):
        del rows[-1], lines[-1]
    if len(rows) < 2:
        raise RecordingError(
            f"{path}: {'holds no rows below its header' if rows else 'the file is empty'}"
        )
    width = len(rows[0])
    for cells, line in zip(rows, lines, strict=True):
        if len(cells) != width:
            raise RecordingError(f"{path}, line {line}: {len(cells)} cells, the header has {width}")
    columns = tuple(zip(*rows[1:], strict=True))
    return Table(path, separator, tuple(rows[0]), columns, tuple(lines[1:]))


def numbers(table: Table, column: int, name: str) -> Float[ndarray, " T"] | None:
    """Return a column as numbers, NaN where a cell is empty; None if all of it is text.

    Raises:
        RecordingError: Text among numbers.
    """
    cells = table.columns[column]
    try:
        return _as_numbers(cells)
    except ValueError:
        pass
    if table.separator != "," and not any("." in cell for cell in cells):
        cells = tuple(cell.replace(",", ".") for cell in cells)
    wrong = [row for row, cell in enumerate(cells) if cell and not _is_number(cell)]
    if not wrong:
        return _as_numbers(cells)
    if len(wrong) == sum(map(bool, cells)):
        return None
    raise RecordingError(
        f"{table.where(wrong[0])}, column '{name}': "
        f"expected a number, got '{table.columns[column][wrong[0]][:40]}'"
    )


def _one_line(cell: str) -> str:
    """Return a cell without blanks around it, and without the line breaks of spreadsheets."""
    text = cell.strip()
    return " ".join(text.split()) if "\n" in text or "\r" in text else text


def _as_numbers(cells: Sequence[str]) -> Float[ndarray, " T"]:
    return np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True
