"""The names of a table's columns: which is the episode's, which is the time's, and their units."""

import re
from collections.abc import Sequence
from pathlib import Path

from motionese.errors import RecordingError, unknown
from motionese.recordings.formats.conventions import is_bookkeeping
from motionese.recordings.formats.csv_cells import is_number

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
_UNIT = rf"({UNIT})(/s(\^?2|²)?)?"
NO_UNIT = ("", "-", "–", "1", "none", "n/a", "[]", "[-]", "()", "(-)")
"""Cells of a row of units below columns that have none."""


def checked_header(path: Path, cells: Sequence[str]) -> tuple[str, ...]:
    """Return the columns' names; `RecordingError` if any but an empty one is doubled."""
    doubled = sorted({cell for cell in cells if cell and list(cells).count(cell) > 1})
    if doubled:
        raise RecordingError(f"{path}: columns must be unique; doubled: {', '.join(doubled)}")
    return tuple(cells)


def is_header(cells: Sequence[str]) -> bool:
    """Tell whether the first line of a table names its columns and holds no values yet."""
    values = [cell for cell in cells if is_number(cell.replace(",", "."))]
    # pandas calls the columns of a bare array 0, 1, 2, …; these are names.
    counted = len(values) > 1 and values == [str(i) for i in range(len(values))]
    named = usual_column(cells, (*EPISODE, *TIME)) is not None
    return not values or counted or named or 2 * len(values) < sum(map(bool, cells))


def units_of(cells: Sequence[str]) -> tuple[str, ...] | None:
    """Return the units of a row of them; None where it is another row."""
    told = [cell for cell in cells if cell.casefold() not in NO_UNIT]
    bare = [re.sub(r"^[\[(](.*)[\])]$", r"\1", cell).strip() for cell in told]
    known = [unit for unit in bare if re.fullmatch(_UNIT, unit)]
    if not known or 2 * len(known) < len(told) or any(is_number(b.replace(",", ".")) for b in bare):
        return None
    units = dict(zip(told, bare, strict=True))
    return tuple(units.get(cell, "") for cell in cells)


def named_column(
    path: Path, names: Sequence[str], given: str | None, usual: Sequence[str]
) -> int | None:
    """Return the column that was named, or else the first of the usual names that is there."""
    if given is None:
        return usual_column(names, usual)
    either = [*names, *(split_unit(name)[0] for name in names)]
    if given in either:
        return either.index(given) % len(names)
    raise RecordingError(f"{path}: {unknown('column', given, filter(None, names))}")


def usual_column(names: Sequence[str], usual: Sequence[str]) -> int | None:
    """Return the column of the first of these names that is there."""
    folded = list(map(folded_name, names))
    return next((folded.index(name) for name in usual if name in folded), None)


def folded_name(name: str) -> str:
    """Return a name without its unit, in lower case; ROS calls the time %time, others __time."""
    return split_unit(name)[0].casefold().lstrip("%_# ")


def is_measured(name: str) -> bool:
    """Whether a column of this name holds more than the row's number, stamp or header."""
    return name.casefold() not in COUNTERS and not is_bookkeeping(name)


def split_unit(name: str) -> tuple[str, str]:
    """Return the name and the unit of "shoulder [rad]" or "shoulder (rad)"; empty where none is.

    Without the space a square bracket belongs to the name, as in "position[0]".
    """
    found = re.fullmatch(r"(.*\S)\s+\[([^\[\]]*)\]", name) or re.fullmatch(
        rf"(.*[^\s(])\s*\(({_UNIT})\)", name
    )
    return (found[1], found[2].strip()) if found else (name, "")


def label(name: str, unit: str) -> str:
    """Return the header from which `split_unit` gives back the name and the unit."""
    return f"{name} [{unit}]" if unit or split_unit(name) != (name, "") else name
