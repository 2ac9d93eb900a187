"""Columns of a table as numbers and as times."""

from datetime import datetime

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.formats.csv_cells import floats, is_number, plain
from motionese.recordings.formats.csv_columns import seconds
from motionese.recordings.formats.csv_table import Table

LATEST_S = 1e11
"""A time [s], since 1970 or any other moment, that no clock shows."""


def numbers(table: Table, column: int) -> tuple[Float[ndarray, " T"], Bool[ndarray, " T"]] | None:
    """Return a column as numbers and what was observed of it; None if all of it is text.

    Raises:
        RecordingError: Text among numbers.
    """
    cells = table.columns[column]
    try:
        return floats(cells), np.array([bool(cell) for cell in cells], dtype=bool)
    except ValueError:
        comma = table.separator != "," and not any("." in cell for cell in cells)
        cells = tuple(plain(cell, decimal_comma=comma) for cell in cells)
    filled = np.array([bool(cell) for cell in cells], dtype=bool)
    wrong = [row for row, cell in enumerate(cells) if cell and not is_number(cell)]
    if not wrong:
        return floats(cells), filled
    first = table.columns[column][wrong[0]]
    # "0,5" is a number, but not where commas separate the cells.
    if len(wrong) == filled.sum() and not is_number(first.replace(",", ".")):
        return None
    raise RecordingError(
        f"{table.where(wrong[0])}, column '{table.header[column]}': "
        f"expected a number, got '{first[:40]}'"
    )


def times(table: Table, column: int) -> Float[ndarray, " T"]:
    """Return a column of times [s], NaN where a cell is empty.

    Raises:
        RecordingError: Text that tells no time.
    """
    name, found = table.header[column], numbers(table, column)
    if found is not None:
        unit = seconds(name)
        return found[0] * (_unit_shown(found[0]) if unit is None else unit)
    dates = _dates(table.columns[column])
    if dates is None:
        raise RecordingError(
            f"{table.where(0)}: column '{name}' holds text, not times in numbers "
            f"or as in 2024-01-31 12:00:00.25, got '{table.columns[column][0][:40]}'"
        )
    return dates


def _unit_shown(stamps: Float[ndarray, " T"]) -> float:
    """Return the unit [s] of stamps that do not tell it: seconds, unless that cannot be meant.

    Clocks count from 1970 in seconds, milliseconds, microseconds or nanoseconds: a number that
    tells of today in one of them does in no other.
    """
    latest = float(np.max(stamps, where=np.isfinite(stamps), initial=0.0))
    return next((unit for unit in (1.0, 1e-3, 1e-6) if latest * unit < LATEST_S), 1e-9)


def _dates(cells: tuple[str, ...]) -> Float[ndarray, " T"] | None:
    """Return dates as times [s] from the first of them; None where one is no date."""
    try:
        moments = [datetime.fromisoformat(cell) if cell else None for cell in cells]
        first = next(moment for moment in moments if moment)
        return np.array([(m - first).total_seconds() if m else np.nan for m in moments])
    except (ValueError, TypeError):
        # Python raises TypeError where some tell their time zone and others do not.
        return None
