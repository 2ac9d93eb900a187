"""What the columns of a table are: which names the episode, which tells the time, which a unit."""

import re
from collections.abc import Sequence
from pathlib import Path

from motionese.errors import RecordingError, unknown
from motionese.recordings.formats.bookkeeping import is_bookkeeping
from motionese.recordings.formats.csv_cells import is_number

EPISODE = (
    "episode",
    "episode_index",
    "episode_id",
    "trial",
    "demo",
    "demonstration",
    "sequence",
    "motion",
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
        for candidates in (names, bare):
            if given in candidates:
                return list(candidates).index(given)
        raise RecordingError(f"{path}: {unknown('column', given, filter(None, names))}")
    # ROS calls the time %time, PlotJuggler __time.
    folded = [name.casefold().lstrip("%_# ") for name in bare]
    return next((folded.index(name) for name in usual if name in folded), None)


def is_measured(name: str) -> bool:
    """Whether a column of this name holds more than the row's number, stamp or header."""
    return name.casefold() not in COUNTERS and not is_bookkeeping(name)


def seconds(name: str) -> float | None:
    """Return the unit of a column of times [s], from "t [ms]" or "time_ms", if it tells one."""
    bare, unit = split_unit(name)
    return SECONDS.get(unit or bare.rpartition("_")[2].casefold())


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
