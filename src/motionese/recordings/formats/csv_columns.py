"""What the columns of a table are: which names the episode, which tells the time, which a unit."""

import re
from collections.abc import Sequence
from pathlib import Path

from motionese.errors import RecordingError, unknown

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
TIME = ("time", "t", "timestamp", "time_s", "time_ms", "time_us", "time_ns", "stamp")
COUNTERS = ("frame", "frame_index", "index", "row")
"""Columns that number the rows: never taken unless they are chosen."""
SECONDS = {"s": 1.0, "sec": 1.0, "ms": 1e-3, "us": 1e-6, "µs": 1e-6, "ns": 1e-9}
"""How long one of each unit of time is [s]."""


def header(path: Path, cells: Sequence[str]) -> Sequence[str]:
    """Return the columns' names; `RecordingError` if the first line holds values instead."""
    values = [cell for cell in cells if _is_number(cell)]
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
    folded = [name.casefold() for name in bare]
    return next((folded.index(name) for name in usual if name in folded), None)


def is_counter(name: str) -> bool:
    """Whether a column of this name only numbers the rows."""
    return name.casefold() in COUNTERS


def seconds(name: str) -> float:
    """Return the unit of a column of times [s], from "t [ms]" or "time_ms"; seconds else."""
    bare, unit = split_unit(name)
    return SECONDS.get(unit or bare.rpartition("_")[2].casefold(), 1.0)


def split_unit(name: str) -> tuple[str, str]:
    """Return the name and the unit of "shoulder [rad]"; an empty unit where none is given.

    Without the space the bracket belongs to the name, as in "position[0]".
    """
    found = re.fullmatch(r"(.*\S)\s+\[([^\[\]]*)\]", name)
    return (found[1], found[2].strip()) if found else (name, "")


def label(name: str, unit: str) -> str:
    """Return the header from which `split_unit` gives back the name and the unit."""
    return f"{name} [{unit}]" if unit or split_unit(name) != (name, "") else name


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return True
