"""The columns of tables as channels: numbers, and words that stand for two states."""

import shlex
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.csv_cells import floats, is_number, plain
from motionese.recordings.formats.csv_names import is_measured, split_unit
from motionese.recordings.formats.csv_table import Table
from motionese.recordings.nature import counts_rows, runs

Numbers = tuple[Float[ndarray, " T"], Bool[ndarray, " T"]]
STATES = (("off", "closed", "close", "shut", "no"), ("on", "open", "opened", "yes"))
"""Words that stand for 0, and words that stand for 1."""
MOST_WORDS = 3
"""Words of a column that are told."""


@dataclass(frozen=True)
class Channel:
    """One column of numbers over all tables.

    Attributes:
        numbers: What it holds in each table; None where it stands among the table's own numbers.
        binary: Whether it was made of words, 0 and 1.
    """

    column: int
    name: str
    unit: str
    numbers: tuple[Numbers, ...] | None
    binary: bool = False


def label_of(table: Table, column: int) -> tuple[str, str]:
    """Return a column's name and unit, as its header or the row of units tells it."""
    name, unit = split_unit(table.header[column])
    return name, unit or (table.units[column] if table.units else "")


def channels_of(
    tables: Sequence[Table], taken: Sequence[int | None], named: bool
) -> tuple[list[Channel], list[Finding]]:
    """Return the channels of tables that have the same columns, and what was left out or converted.

    Args:
        tables: One or more, with the same header.
        taken: Columns that name the episodes or tell the time.
        named: Whether anything names the episodes already.
    """
    channels, findings = [], []
    for column, name in enumerate(tables[0].header):
        if column not in taken:
            channel, finding = _channel(tables, column, named)
            channels += [channel] if channel and name else []
            findings += [finding] if finding else []
    return channels, findings


def matrix(
    table: Table, number: int, channels: Sequence[Channel]
) -> tuple[Float[ndarray, "T D"], Bool[ndarray, "T D"]]:
    """Return what channels hold in the table of this number; a view where that can be."""
    if all(c.numbers is None for c in channels):
        places = [table.plain[c.column] for c in channels]
        if places == list(range(places[0], places[0] + len(places))):
            columns = slice(places[0], places[0] + len(places))
            return table.numbers[:, columns], table.observed[:, columns]
        return table.numbers[:, places], table.observed[:, places]
    found = [_own(table, c.column) if c.numbers is None else c.numbers[number] for c in channels]
    values, observed = (np.stack(kind, axis=1) for kind in zip(*found, strict=True))
    return values, observed


def numbers(table: Table, column: int) -> Numbers | None:
    """Return a column as numbers and what was observed of it; None if all of it is text."""
    if column in table.plain:
        return _own(table, column)
    cells = table.cells[column]
    try:
        return floats(cells), np.array([bool(cell) for cell in cells], dtype=bool)
    except ValueError:
        comma = table.separator != "," and not any("." in cell for cell in cells)
        cells = tuple(plain(cell, decimal_comma=comma) for cell in cells)
    filled = np.array([bool(cell) for cell in cells], dtype=bool)
    wrong = [row for row, cell in enumerate(cells) if cell and not is_number(cell)]
    if not wrong:
        return floats(cells), filled
    first = table.cells[column][wrong[0]]
    # "0,5" is a number, but not where commas separate the cells.
    if len(wrong) == filled.sum() and not is_number(first.replace(",", ".")):
        return None
    raise RecordingError(
        f"{table.where(wrong[0])}, column '{table.header[column]}': "
        f"expected a number, got '{first[:40]}'"
    )


def _channel(
    tables: Sequence[Table], column: int, named: bool
) -> tuple[Channel | None, Finding | None]:
    name, unit = label_of(tables[0], column)
    if all(column in table.plain for table in tables):
        return Channel(column, name, unit, None), _nameless(tables, column)
    found = [numbers(table, column) for table in tables]
    if all(f is not None for f in found):
        channel = Channel(column, name, unit, tuple(f for f in found if f is not None))
        return channel, _nameless(tables, column)
    if not name or not is_measured(name):
        return None, None
    for table, here in zip(tables, found, strict=True):
        if here is not None and here[1].any():
            raise RecordingError(
                f"{table.path}: column '{name}' holds numbers; in other files it holds words"
            )
    return _worded(tables, column, named)


def _worded(tables: Sequence[Table], column: int, named: bool) -> tuple[Channel | None, Finding]:
    """Return a column of two words as 0 and 1, and what is to be told of any column of words."""
    name, _ = label_of(tables[0], column)
    cells = [[plain(cell, decimal_comma=False) for cell in t.text(column)] for t in tables]
    shown = {cell.casefold(): cell for table in reversed(cells) for cell in table if cell}
    words = sorted(shown, key=lambda word: (_state(word), word))
    apart = sum(len(runs(table)) for table in cells) == len(words)
    names = f"--episode {shlex.quote(name)}, if it names the episodes"
    states = all(_state(word) < len(STATES) for word in words)
    remedy = names if apart and len(words) > 1 and not (named or states) else ""
    if len(words) == 2:
        number = {word: float(i) for i, word in enumerate(words)} | {"": np.nan}
        values = [np.array([number[cell.casefold()] for cell in table]) for table in cells]
        what = f"'{shown[words[0]]}' is read as 0, '{shown[words[1]]}' as 1"
        found = tuple((v, ~np.isnan(v)) for v in values)
        finding = Finding("converted", tables[0].path, what, remedy, channel=name)
        return Channel(column, name, "", found, binary=True), finding
    listed = ", ".join(f"'{shown[word][:40]}'" for word in words[:MOST_WORDS])
    more = ", …" if len(words) > MOST_WORDS else ""
    what = f"holds words, not numbers ({listed}{more}); it is left out"
    return None, Finding("left out", tables[0].path, what, remedy, channel=name)


def _state(word: str) -> int:
    return next((i for i, words in enumerate(STATES) if word in words), len(STATES))


def _nameless(tables: Sequence[Table], column: int) -> Finding | None:
    """Return what is to be told of a column without a name, unless it numbers the rows."""
    if tables[0].header[column]:
        return None
    found = [numbers(table, column) for table in tables]
    seen = [values[mask] for values, mask in (f for f in found if f is not None)]
    numbered = all((np.diff(values) == 1).all() for values in seen)
    if numbered or counts_rows(seen):
        return None
    what = f"column {column + 1} has no name in the first line; it is left out"
    return Finding("left out", tables[0].path, what)


def _own(table: Table, column: int) -> Numbers:
    place = table.plain[column]
    return table.numbers[:, place], table.observed[:, place]
