"""The columns of a table: episode, time or channel, in which unit; as numbers and as times."""

import re
from collections.abc import Sequence
from datetime import datetime
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError, unknown
from motionese.recordings.formats.conventions import is_bookkeeping
from motionese.recordings.formats.csv_table import Table, floats, is_number, plain

EPISODE = (
    *("episode", "episode_index", "episode_id"),
    *("trial", "demo", "demonstration", "sequence", "motion"),
)
SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9}
"""How long one of each unit of time is [s]."""
TIME = (
    *("time", "t", "timestamp", "stamp", "seconds"),
    *(f"{name}_{unit}" for name in ("time", "timestamp") for unit in SECONDS),
)
COUNTERS = ("frame", "frame_index", "index", "row", "sample", "unnamed: 0")
"""Columns that number the rows: never taken unless they are chosen."""
UNIT = r"rad|deg|°|degrees|radians|%|px|pixels|[cmkµu]?(m|s|N|V|A|g)|sec|ns|Nm|N·m|N\*m|°C|Pa"
"""Units that are understood in round brackets, in which names may have other things as well."""
LATEST_S = 1e11
"""A time [s], since 1970 or any other moment, that no clock shows."""


def header(path: Path, cells: Sequence[str]) -> Sequence[str]:
    """Return the columns' names; `RecordingError` if the first line holds values instead."""
    values = [cell for cell in cells if is_number(cell.replace(",", "."))]
    # pandas calls the columns of a bare array 0, 1, 2, …; these are names.
    counted = len(values) > 1 and values == [str(i) for i in range(len(values))]
    named = named_column(path, cells, None, (*EPISODE, *TIME)) is not None
    if values and not (counted or named) and 2 * len(values) >= sum(map(bool, cells)):
        raise RecordingError(
            f"{path}: the first line holds values ({', '.join(cells[:3])}, …); "
            "it must name the columns"
        )
    doubled = sorted({cell for cell in cells if cell and list(cells).count(cell) > 1})
    if doubled:
        raise RecordingError(f"{path}: columns must be unique; doubled: {', '.join(doubled)}")
    return cells


def named_column(
    path: Path, names: Sequence[str], given: str | None, usual: Sequence[str]
) -> int | None:
    """Return the column that was named, or else the first of the usual names that is there."""
    bare = [split_unit(name)[0] for name in names]
    if given is not None:
        if given in (either := [*names, *bare]):
            return either.index(given) % len(names)
        raise RecordingError(f"{path}: {unknown('column', given, filter(None, names))}")
    # ROS calls the time %time, PlotJuggler __time.
    folded = [name.casefold().lstrip("%_# ") for name in bare]
    return next((folded.index(name) for name in usual if name in folded), None)


def is_measured(name: str) -> bool:
    """Whether a column of this name holds more than the row's number, stamp or header."""
    return name.casefold() not in COUNTERS and not is_bookkeeping(name)


def split_unit(name: str) -> tuple[str, str]:
    """Return the name and the unit of "shoulder [rad]" or "shoulder (rad)"; empty where none is.

    Without the space a square bracket belongs to the name, as in "position[0]".
    """
    found = re.fullmatch(r"(.*\S)\s+\[([^\[\]]*)\]", name) or re.fullmatch(
        rf"(.*[^\s(])\s*\((({UNIT})(/s(\^?2|²)?)?)\)", name
    )
    return (found[1], found[2].strip()) if found else (name, "")


def label(name: str, unit: str) -> str:
    """Return the header from which `split_unit` gives back the name and the unit."""
    return f"{name} [{unit}]" if unit or split_unit(name) != (name, "") else name


def numbers(table: Table, column: int) -> tuple[Float[ndarray, " T"], Bool[ndarray, " T"]] | None:
    """Return a column as numbers and what was observed of it; None if all of it is text."""
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
    """Return a column of times [s], NaN where a cell is empty."""
    name, found = table.header[column], numbers(table, column)
    if found is not None:
        bare, unit = split_unit(name)
        told = SECONDS.get(unit or bare.rpartition("_")[2].casefold())
        return found[0] * (_unit_shown(found[0]) if told is None else told)
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
