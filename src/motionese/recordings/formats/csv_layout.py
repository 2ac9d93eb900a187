"""Where in a text its table is: lines of words above it, names, units, and the first row."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import takewhile

from motionese.recordings.formats.csv_cells import is_number, is_value
from motionese.recordings.formats.csv_names import is_header, units_of

SEPARATORS = ",;\t"
COMMENTS = ("#", "%", "sep=")
"""What lines above a table begin with that are no rows of it, or that name its columns."""
LOOK = 25
"""Lines by which it is known whether they are a table."""
MOST_ABOVE = 100
"""Lines of words that a table may have above it."""


@dataclass(frozen=True)
class Layout:
    """How a text holds its table.

    Attributes:
        separator: What stands between two cells; a blank for any number of blanks.
        header: The names of the columns; empty where there are none.
        units: Of a row below the names; empty where there is none.
        body: How many lines stand above the first row.
        row: The first row.
        above: Lines of words above the names that are no comments.
        sure: Whether what follows looks like rows of a table.
    """

    separator: str
    header: tuple[str, ...]
    units: tuple[str, ...]
    body: int
    row: tuple[str, ...]
    above: tuple[str, ...]
    sure: bool


def layout(lines: Sequence[str]) -> Layout:
    """Return where the table is in a text whose first lines these are."""
    start = len(list(takewhile(lambda line: _is_comment(line) or not line.strip(), lines)))
    first = _at(lines, start, ())
    for line in range(start + 1, min(start + MOST_ABOVE, len(lines))):
        if first.sure:
            break
        if lines[line].strip() and not _is_comment(lines[line]):
            above = tuple(words for words in lines[start:line] if words.strip())
            if (found := _at(lines, line, above)).sure:
                return found
    return first


def rows_of(
    lines: Sequence[str], separator: str, width: int | None = None
) -> tuple[list[list[str]], list[int]]:
    """Return the cells of every row, and the line in which it ends, counted from 1.

    Rows of another width than `width` (that of the first row where it is None) may be comments.

    Raises:
        csv.Error: A cell in quotes that does not end.
    """
    rows: list[list[str]] = []
    ends: list[int] = []
    reader = csv.reader(lines, delimiter=separator, skipinitialspace=separator == " ", strict=True)
    try:
        for row in reader:
            width = len(row) if width is None and row else width
            if row and not (len(row) != width and row[0].startswith(COMMENTS)):
                rows.append([_one_line(cell) for cell in row])
                ends.append(reader.line_num)
    except csv.Error as error:
        raise csv.Error(f"line {reader.line_num}: not a csv file: {error}") from error
    return rows, ends


def _at(lines: Sequence[str], start: int, above: tuple[str, ...]) -> Layout:
    """Return the table that begins with the line `start`, if it is one."""
    ahead = lines[start : start + LOOK]
    separator = _separator(ahead)
    try:
        rows, ends = rows_of(ahead, separator)
    except csv.Error:
        rows, ends = [], []
    if not rows:
        return Layout(separator, (), (), start, (), above, sure=False)
    header: tuple[str, ...] = ()
    below = 0
    if named := _named_above(lines[:start], rows[0], separator):
        header = named
    elif is_header(rows[0]):
        header, below = tuple(rows[0]), 1
    alike = below and len(rows) > 2 and len(rows[1]) == len(rows[0]) and is_row(rows[2])
    units = units_of(rows[1]) if alike else None
    below += units is not None
    body, width = rows[below:], len(rows[0])
    fitting = sum(len(row) >= width and not any(row[width:]) for row in body)
    sure = bool(body) and 2 * fitting >= len(body) and all(map(is_row, body))
    if above:
        prose = header or all(len(line.split(separator)) == 1 for line in above)
        sure = sure and bool(prose) and len(body) > 1 and (width > 1 or all(map(_is_bare, body)))
    end = start + ends[below - 1] if below else start
    return Layout(separator, header, units or (), end, tuple(body[0] if body else ()), above, sure)


def is_row(cells: Sequence[str]) -> bool:
    """Tell whether cells may be a row of a table: one of them is a value, or none is filled."""
    return not any(cells) or any(is_value(cell) for cell in cells if cell)


def _named_above(above: Sequence[str], row: list[str], separator: str) -> tuple[str, ...]:
    """Return the names of columns in a comment: NumPy's savetxt and ROS write them so."""
    if not above or not any(is_number(cell.replace(",", ".")) for cell in row):
        return ()
    parts = above[-1].lstrip("#% ").split(None if separator == " " else separator)
    named = tuple(part.strip(' "\r\n') for part in parts)
    return named if len(named) == len(row) and not any(map(is_number, named)) else ()


def _separator(lines: Sequence[str]) -> str:
    first = lines[0] if lines else ""
    if any(mark in first for mark in SEPARATORS):
        return max(SEPARATORS, key=first.count)
    rows = [line for line in lines[:3] if line.strip()]
    # A name may hold blanks; a number does not.
    return " " if len(rows) > 1 and len(rows[1].split()) > 1 else ","


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith(COMMENTS)


def _is_bare(cells: Sequence[str]) -> bool:
    return all(map(is_number, cells))


def _one_line(cell: str) -> str:
    """Return a cell without blanks around it, and without the line breaks of spreadsheets."""
    text = cell.strip()
    return " ".join(text.split()) if "\n" in text or "\r" in text else text
