"""Datasets of HDF5 as channels: one row an instant, whatever layout they stand in.

Channels are the datasets of numbers [T] and [T, n]: floating-point ones wherever they are, whole
numbers and truth values among observations and actions. They are named PATH or PATH_0, PATH_1, …;
pictures are left alone. A dataset that we wrote says in its attributes `names` and `units` what
its columns are.
"""

import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.conventions import WIDEST, is_bookkeeping, strings
from motionese.recordings.rate import FASTEST_HZ
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.stored import StoredRecording

DERIVED = "derived_from"
"""Attribute of a dataset that is computed from another one, so that reading leaves it out."""
ACTIONS = ("action", "actions")
NUMBERS = "fiub"
ROWS = "num_samples"
"""Attribute of an episode that tells how many rows it has."""
RATES = ("control_freq", "control_frequency", "fps", "hz", "rate_hz", "frequency")
"""Attributes that tell rows per second."""


class _Columns(NamedTuple):
    """The channels of one dataset, which has the same columns in every episode."""

    dataset: str
    names: tuple[str, ...]
    units: tuple[str, ...]


def stored_in(
    source: Path,
    groups: Sequence[tuple[str, Any]],
    datasets: Sequence[str],
    observed: str,
    rate_hz: float | None,
    *,
    usual: str = "",
    ahead: Sequence[str] = (),
) -> StoredRecording:
    """Return the episodes that stand in these groups, by name, with the channels of the first.

    Args:
        source: The file.
        groups: At least one.
        datasets: Paths in a group of what may be channels.
        observed: The path of observations, which channels are named without.
        rate_hz: What is told of it [Hz].
        usual: The path of the channels that are usual; observations where left out; actions where
            there are none.
        ahead: Paths of datasets that may be a row longer than all others, which are a gap there.

    Raises:
        RecordingError: No channels, or an episode that does not have those of the first, or not
            as many rows everywhere.
    """
    _, first = groups[0]
    if not (columns := tuple(_columns(first, datasets, observed))):
        raise RecordingError(f"{_where(source, first)} has no datasets of numbers [T] or [T, n]")
    preferred = [
        [
            c
            for c in columns
            if under(c.dataset, usual or observed) and not is_bookkeeping(c.dataset)
        ],
        [c for c in columns if under(c.dataset, *ACTIONS)],
        columns,
    ]
    names = tuple(n for c in columns for n in c.names)
    nothing = np.empty((0, len(names)))
    outline = Recording(
        source=source,
        channels=names,
        units=tuple(u for c in columns for u in c.units),
        ranges={},
        rate_hz=rate_hz,
        episodes=tuple(Episode.whole(name, nothing) for name, _ in groups),
        usual=tuple(n for c in next(filter(None, preferred)) for n in c.names),
        findings=tuple(_too_wide(source, first, datasets)),
    )
    return StoredRecording(outline, lambda i: _episode(source, *groups[i], columns, ahead))


def recording_of(
    source: Path,
    groups: Sequence[tuple[str, Any]],
    datasets: Sequence[str],
    observed: str,
    rate_hz: float | None,
    **more: Any,
) -> Recording:
    """Return the same recording with all episodes read; arguments as of `stored_in`."""
    return stored_in(source, groups, datasets, observed, rate_hz, **more).whole()


def paths(item: Any) -> list[str]:
    """Return the paths of all that is in a group, at any depth; none of anything else."""
    found: list[str] = []
    if is_group(item):
        item.visit(found.append)
    return found


def is_group(item: Any) -> bool:
    """Tell a group from a dataset, and from nothing."""
    return hasattr(item, "keys")


def is_dataset(item: Any) -> bool:
    """Tell a dataset from a group, from a type of data, and from nothing."""
    return hasattr(item, "ndim")


def under(path: str, *folders: str) -> bool:
    """Tell whether a path is one of these, or in one of them."""
    return any(path == folder or path.startswith(f"{folder}/") for folder in folders)


def width(item: Any, kinds: str = NUMBERS) -> int:
    """Return how many columns a dataset [T] or [T, n] of such numbers has; 0 for anything else."""
    if not is_dataset(item) or item.dtype.kind not in kinds or item.ndim not in {1, 2}:
        return 0
    if item.ndim == 2 and item.dtype == np.uint8:
        return 0  # a compressed picture in every row
    return 1 if item.ndim == 1 else int(item.shape[1])


def rate_in(told: Any) -> float | None:
    """Return the rows per second [Hz] that attributes, or a table of JSON, tell under any name."""
    for key in RATES if hasattr(told, "get") else ():
        rate = told.get(key)
        if isinstance(rate, int | float | np.integer | np.floating) and 0 < rate <= FASTEST_HZ:
            return float(rate)
    return None


def read_json(text: Any) -> Any:
    """Return what a text of JSON holds; None for anything else."""
    try:
        return json.loads(text)
    except (TypeError, ValueError, RecursionError):
        return None


def _columns(group: Any, datasets: Sequence[str], observed: str) -> Iterable[_Columns]:
    for path in datasets:
        dataset = group[path]
        count = width(dataset, NUMBERS if under(path, observed, *ACTIONS) else "f")
        if not 0 < count <= WIDEST or DERIVED in dataset.attrs:
            continue
        named, units = (strings(read_json(dataset.attrs.get(a)), count) for a in ("names", "units"))
        label = path.removeprefix(f"{observed}/")
        label = path if label in datasets else label
        plain = (label,) if dataset.ndim == 1 else tuple(f"{label}_{i}" for i in range(count))
        yield _Columns(path, named or plain, units or ("",) * count)


def _too_wide(source: Path, group: Any, datasets: Sequence[str]) -> Iterable[Finding]:
    for path in datasets:
        if (count := width(group[path], "f")) > WIDEST:
            what = f"dataset {path} has {count} columns, more than the {WIDEST} that are read"
            yield Finding("left out", source, what)


def _where(source: Path, group: Any) -> str:
    name = group.name.rpartition("/")[2]
    return f"{source}: '{name}'" if name else f"{source}"


def _episode(
    source: Path, name: str, group: Any, columns: tuple[_Columns, ...], ahead: Sequence[str]
) -> Episode:
    where = _where(source, group)
    counts = dict(_counts(where, group, columns))
    (first, rows), *_ = counts.items()
    longest = max(counts.values()) if ahead else rows
    late = {p for p, n in counts.items() if n == longest - 1 and ahead and not under(p, *ahead)}
    for what, count in counts.items():
        if count != longest and what not in late:
            raise RecordingError(
                f"{where}: {first} has {rows} rows, {what} {count}; they must agree"
            )
    values = np.zeros((longest, sum(len(c.names) for c in columns)))
    observed, start = np.zeros(values.shape, dtype=bool), 0
    for path, names, _ in columns:
        cells = slice(counts[path]), slice(start, start + len(names))
        values[cells] = np.asarray(group[path][()]).reshape(-1, len(names))
        observed[cells] = True
        start += len(names)
    return Episode(name, None, values, observed)


def _counts(where: str, group: Any, columns: tuple[_Columns, ...]) -> Iterable[tuple[str, int]]:
    """Yield what tells how many rows an episode has, and how many."""
    for path, names, _ in columns:
        dataset = group.get(path)
        if width(dataset) != len(names):
            raise RecordingError(
                f"{where} has no dataset {path} of {len(names)} columns, which the first "
                "demonstration has"
            )
        yield path, len(dataset)
    told = group.attrs.get(ROWS)
    if isinstance(told, int | np.integer):
        yield f"its attribute {ROWS}", int(told)
