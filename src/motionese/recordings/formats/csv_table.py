"""A text file as a table: which line is at fault, columns of cells, and rows of plain numbers."""

import csv
import io
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError, SettingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.csv_arrow import LARGE, read_large_body
from motionese.recordings.formats.csv_body import read_body
from motionese.recordings.formats.csv_cells import is_number
from motionese.recordings.formats.csv_layout import Layout, layout, rows_of
from motionese.recordings.formats.csv_names import checked_header
from motionese.recordings.formats.csv_text import decoded
from motionese.recordings.formats.numbered_columns import numbered_columns

HEAD = 1 << 20
"""Bytes in which a table's first rows stand."""
LINES = 200
"""Lines by which it is known where the table is."""


@dataclass(frozen=True)
class Table:
    """The rows of a text file.

    Attributes:
        separator: What stands between two cells; a blank for any number of blanks.
        header: The names of the columns.
        units: Of the row of units below the names; empty where there is none.
        lines: The line of the file in which each row ends, counted from 1.
        cells: Columns as they are written, without blanks around the cells.
        plain: Columns that were read as numbers at once, each with its place in `numbers`.
        named: Whether the file, or the user, names the columns.
    """

    path: Path
    separator: str
    header: tuple[str, ...]
    units: tuple[str, ...]
    lines: Sequence[int]
    cells: Mapping[int, tuple[str, ...]]
    plain: Mapping[int, int] = field(default_factory=dict)
    numbers: Float[ndarray, "T K"] = field(default_factory=lambda: np.empty((0, 0)))
    observed: Bool[ndarray, "T K"] = field(default_factory=lambda: np.empty((0, 0), dtype=bool))
    named: bool = True
    findings: tuple[Finding, ...] = ()

    def where(self, row: int) -> str:
        """Return the file and line of a row, for messages."""
        return f"{self.path}, line {self.lines[row]}"

    def text(self, column: int) -> Sequence[str]:
        """Return a column as it is written, or as its numbers are."""
        if column in self.cells:
            return self.cells[column]
        place = self.plain[column]
        pairs = zip(self.numbers[:, place], self.observed[:, place], strict=True)
        return [f"{value:.17g}" if seen else "" for value, seen in pairs]

    def in_order(self, header: Sequence[str]) -> "Table":
        """Return the table with its columns in another order."""
        order = [self.header.index(name) for name in header]
        return replace(
            self,
            header=tuple(header),
            units=tuple(self.units[i] for i in order) if self.units else (),
            cells={new: self.cells[old] for new, old in enumerate(order) if old in self.cells},
            plain={new: self.plain[old] for new, old in enumerate(order) if old in self.plain},
        )


def read_table(path: Path, columns: Sequence[str] | None, is_text: Callable[[str], bool]) -> Table:
    """Read a text file.

    Args:
        path: The file.
        columns: Names of its columns, where it has no header.
        is_text: Which names are those of columns that are wanted as they are written.

    Raises:
        RecordingError: No text, no table, or a line that is wider than the header.
        SettingError: Names for columns that have some, or not as many.
    """
    try:
        return _plainly(path, columns, is_text) or _carefully(path, columns)
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error


def holds_table(path: Path) -> bool:
    """Tell whether a text file begins as a table does, perhaps below some lines of words."""
    try:
        with path.open("rb") as file:
            text, _ = decoded(path, file.read(HEAD))
    except (OSError, RecordingError):
        return False
    return layout(_first_lines(text)).sure


def _plainly(
    path: Path, columns: Sequence[str] | None, is_text: Callable[[str], bool]
) -> Table | None:
    """Return a table whose rows are plain; None where any of them is not."""
    with path.open("rb") as file:
        head = file.read(HEAD)
        marked = 3 * head.startswith(b"\xef\xbb\xbf")
        whole = head[marked:] if len(head) < HEAD else head[marked : head.rfind(b"\n") + 1]
        try:
            lines = _first_lines(whole.decode())
        except UnicodeDecodeError:
            return None
        found = layout(lines)
        if not found.sure:
            return None
        header, findings = _header(path, found, columns)
        textual = [
            i
            for i, (name, cell) in enumerate(zip(header, found.row, strict=False))
            if is_text(name) or (cell and not is_number(cell))
        ]
        file.seek(marked + sum(len(line.encode()) for line in lines[: found.body]))
        start = file.tell()
        asked = (file, found.separator, len(header), textual)
        body = read_large_body(*asked) if path.stat().st_size > LARGE else None
        if body is None:
            file.seek(start)
            body = read_body(*asked)
    if body is None:
        return None
    numbers, observed, words = body
    rest = [i for i in range(len(header)) if i not in textual]
    return Table(
        path,
        found.separator,
        header,
        found.units,
        range(found.body + 1, found.body + 1 + len(numbers)),
        dict(zip(textual, words, strict=True)),
        {column: place for place, column in enumerate(rest)},
        numbers,
        observed,
        bool(found.header or columns),
        findings,
    )


def _carefully(path: Path, columns: Sequence[str] | None) -> Table:
    text, guess = decoded(path, path.read_bytes())
    found = layout(_first_lines(text))
    header, findings = _header(path, found, columns)
    if guess:
        findings = (Finding("converted", path, guess), *findings)
    lines = io.StringIO(text, newline="").readlines()
    lines[: found.body] = ["\n"] * found.body
    try:
        rows, ends = rows_of(lines, found.separator, len(header))
    except csv.Error as error:
        raise RecordingError(f"{path}, {error}") from error
    # Spreadsheets end a table with lines of nothing but separators.
    while rows and not any(rows[-1]):
        del rows[-1], ends[-1]
    if not rows:
        raise RecordingError(
            f"{path}: {'holds no rows below its header' if any(header) else 'the file is empty'}"
        )
    if len(rows[-1]) < len(header) and not text.endswith(("\n", "\r")):
        raise RecordingError(
            f"{path}, line {ends[-1]}: the file is cut short inside a row "
            f"({len(rows[-1])} cells, the header has {len(header)})"
        )
    fitted = [_fitted(path, r, line, len(header)) for r, line in zip(rows, ends, strict=True)]
    cells = dict(enumerate(zip(*fitted, strict=True)))
    named = bool(found.header or columns)
    return Table(
        path, found.separator, header, found.units, ends, cells, named=named, findings=findings
    )


def _header(
    path: Path, found: Layout, columns: Sequence[str] | None
) -> tuple[tuple[str, ...], tuple[Finding, ...]]:
    """Return the names of a table's columns, and what was found above its rows."""
    width, findings = len(found.header or found.row), []
    if found.above:
        first, more = found.above[0].strip()[:40], len(found.above) - 1
        what = f"the line '{first}'{f' and {more} more' if more else ''} above the table"
        findings.append(Finding("left out", path, f"{what}: words, not read"))
    if found.header:
        if columns is not None:
            raise SettingError(
                f"{path}: its columns have names ({', '.join(found.header[:4])}, …); "
                "--columns names those of a table without a header"
            )
        return checked_header(path, found.header), tuple(findings)
    names, told = numbered_columns(path, width, columns)
    return checked_header(path, names), (*findings, *told)


def _first_lines(text: str) -> list[str]:
    return list(islice(io.StringIO(text, newline=""), LINES))


def _fitted(path: Path, cells: list[str], line: int, width: int) -> list[str]:
    """Return as many cells as the header has: what is missing at the end of a row is empty."""
    if any(cells[width:]):
        raise RecordingError(f"{path}, line {line}: {len(cells)} cells, the header has {width}")
    return cells[:width] + [""] * (width - len(cells))
