"""When the rows of tables were recorded: which columns tell it, and in which unit."""

import re
import shlex
from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.csv_cells import moment
from motionese.recordings.formats.csv_columns import label_of, numbers
from motionese.recordings.formats.csv_names import (
    SECONDS,
    TIME,
    folded_name,
    named_column,
)
from motionese.recordings.formats.csv_table import Table
from motionese.recordings.nature import CLOCKS, rises_evenly, since_1970

Stamps = Float[ndarray, " T"]
WHOLE = re.compile(r"(|.*[._/ ])(s|secs?|seconds?)")
PARTS = {
    1e-9: "(ns|nsecs?|nanosecs?|nanoseconds?)",
    1e-6: "(us|µs|usecs?|microsecs?|microseconds?)",
    1e-3: "(ms|msecs?|millisecs?|milliseconds?)",
}
"""Names of the two columns that some programs divide a stamp into, by the unit of the second."""
OF_TIME = re.compile(
    r".*(time|stamp|clock|elapsed|zeit|date|(^|[_. ])(t|secs?|seconds))($|[_. ]).*"
)
"""Names that may be those of a clock."""
LATEST_S = 1e11
"""A time [s], since 1970 or any other moment, that no clock shows."""
SLOWEST_S, SHORTEST_S, LONGEST_S = 2.0, 0.5e-3, 0.5
"""Where no unit is told, an interval [s] longer than the first is one between the other two."""


def time_columns(
    tables: Sequence[Table], given: str | None
) -> tuple[tuple[int, ...], list[Finding]]:
    """Return the column of the time, or those of its seconds and what is beyond them, if any."""
    first = tables[0]
    by_name = named_column(first.path, first.header, given, TIME)
    pairs = [pair for pair in _pairs(first.header) if _is_pair(tables, *pair)]
    mine = [pair for pair in pairs if by_name in pair] if by_name is not None else pairs
    if mine:
        return mine[0], []
    if by_name is not None:
        return (by_name,), []
    return _by_nature(tables)


def times(
    tables: Sequence[Table], columns: tuple[int, ...]
) -> tuple[list[Stamps] | None, list[Finding]]:
    """Return the times [s] of the rows of every table, NaN where a cell is empty."""
    if not columns:
        return None, []
    if len(columns) == 2:
        whole, part = ([_numbered(table, c) for table in tables] for c in columns)
        unit = _unit_of_part(tables[0].header, *columns)
        # Seconds since 1970 leave no room for nanoseconds in a double.
        start = min((float(np.nanmin(w)) for w in whole if not np.isnan(w).all()), default=0.0)
        return [w - start + unit * p for w, p in zip(whole, part, strict=True)], []
    found = [numbers(table, columns[0]) for table in tables]
    stamps = [values for values, _ in (f for f in found if f is not None)]
    if len(stamps) < len(tables):
        return [_dates(table, columns[0]) for table in tables], []
    told = _told(tables[0], columns[0])
    unit = told if told is not None else _shown(stamps)
    findings = []
    if told is None and unit == 1.0 and (unit := _slow(stamps)) < 1.0:
        name, _ = label_of(tables[0], columns[0])
        what = (
            f"tells no unit and is read as {CLOCKS[unit]}, since as seconds its rows are too slow"
        )
        remedy = f"call it '{name} [s]' in the file if it is in seconds"
        findings = [Finding("time", tables[0].path, what, remedy, channel=name)]
    return [unit * values for values in stamps], findings


def _pairs(header: Sequence[str]) -> list[tuple[int, int]]:
    names = list(map(folded_name, header))
    found = [(i, WHOLE.fullmatch(name)) for i, name in enumerate(names)]
    return [
        (i, k)
        for i, whole in found
        for k, name in enumerate(names)
        if whole and any(re.fullmatch(re.escape(whole[1]) + part, name) for part in PARTS.values())
    ]


def _unit_of_part(header: Sequence[str], whole: int, part: int) -> float:
    found = WHOLE.fullmatch(folded_name(header[whole]))
    assert found is not None
    rest = folded_name(header[part]).removeprefix(found[1])
    return next(unit for unit, names in PARTS.items() if re.fullmatch(names, rest))


def _is_pair(tables: Sequence[Table], whole: int, part: int) -> bool:
    """Tell whether the second column goes on where the first, in whole seconds, leaves off."""
    most = 1 / _unit_of_part(tables[0].header, whole, part)
    for table in tables:
        try:
            seconds, rest = numbers(table, whole), numbers(table, part)
        except RecordingError:
            return False
        if seconds is None or rest is None or not seconds[1].all() or not rest[1].all():
            return False
        if (seconds[0] != np.round(seconds[0])).any() or not (
            (rest[0] >= 0) & (rest[0] < most)
        ).all():
            return False
    return True


def _by_nature(tables: Sequence[Table]) -> tuple[tuple[int, ...], list[Finding]]:
    """Return the column that is surely a clock, whatever its name; those named so come first."""
    header = tables[0].header
    order = sorted(range(len(header)), key=lambda i: not OF_TIME.fullmatch(folded_name(header[i])))
    for column in order:
        if header[column] and _is_clock(tables, column):
            name, _ = label_of(tables[0], column)
            what = "rises as a clock does and is taken for the time, as no column is called so"
            remedy = f"--time {shlex.quote(name)} says so"
            if not tables[0].named:
                remedy = "--columns names the columns"
            return (column,), [Finding("time", tables[0].path, what, remedy, channel=name)]
    return (), []


def _is_clock(tables: Sequence[Table], column: int) -> bool:
    try:
        found = [numbers(table, column) for table in tables]
    except RecordingError:
        return False
    called = OF_TIME.fullmatch(folded_name(tables[0].header[column])) is not None
    if any(f is None for f in found):
        cells = [cell for table in tables for cell in table.text(column)[:3] if cell]
        return bool(cells) and all(moment(cell) is not None for cell in cells)
    seen = [values for values, mask in (f for f in found if f is not None) if mask.all()]
    if len(seen) < len(found) or min(map(len, seen)) < 3:
        return False
    first = column == 0 and not tables[0].named
    counted = all((np.diff(values) == 1).all() for values in seen)
    evenly = (called or first) and not counted and all(map(rises_evenly, seen))
    return evenly or since_1970(seen) is not None


def _numbered(table: Table, column: int) -> Stamps:
    found = numbers(table, column)
    assert found is not None
    return found[0]


def _told(table: Table, column: int) -> float | None:
    """Return the unit [s] that a column's header or name tells."""
    bare, unit = label_of(table, column)
    for told in (unit, bare.rpartition("_")[2], bare):
        if told.casefold() in SECONDS:
            return SECONDS[told.casefold()]
    return None


def _shown(stamps: Sequence[Stamps]) -> float:
    """Return the unit [s] of stamps that do not tell it: seconds, unless that cannot be meant.

    Clocks count from 1970 in seconds, milliseconds, microseconds or nanoseconds: a number that
    tells of today in one of them does in no other.
    """
    latest = max(float(np.max(s, where=np.isfinite(s), initial=0.0)) for s in stamps)
    return next((unit for unit in (1.0, 1e-3, 1e-6) if latest * unit < LATEST_S), 1e-9)


def _slow(stamps: Sequence[Stamps]) -> float:
    """Return the unit [s] in which rows are a motion's, where as seconds they are too far apart."""
    steps = np.concatenate([np.diff(s) for s in stamps])
    steps = steps[steps > 0]
    usual = float(np.median(steps)) if len(steps) else 0.0
    if not SLOWEST_S < usual < np.inf:
        return 1.0
    return next((u for u in CLOCKS if SHORTEST_S <= usual * u <= LONGEST_S), 1.0)


def _dates(table: Table, column: int) -> Stamps:
    """Return dates as times [s] from the first of them."""
    cells = table.text(column)
    moments = [moment(cell) if cell else None for cell in cells]
    first = next((m for m in moments if m), None)
    wrong = next((i for i, (c, m) in enumerate(zip(cells, moments, strict=True)) if c and not m), 0)
    try:
        if first is None or (cells[wrong] and moments[wrong] is None):
            raise TypeError
        return np.array([(m - first).total_seconds() if m else np.nan for m in moments])
    except TypeError as error:
        # Python raises it where some tell their time zone and others do not.
        raise RecordingError(
            f"{table.where(wrong)}: column '{table.header[column]}' holds text, not times in "
            f"numbers or as in 2024-01-31 12:00:00.25, got '{cells[wrong][:40]}'"
        ) from error
