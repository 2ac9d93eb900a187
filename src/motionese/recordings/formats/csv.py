"""Tables of text: one file with a column that names the episode, or a folder with one file each.

A first line names the columns, as "shoulder [rad]" where the unit is known. An empty cell is a
value that was not observed. Separated by comma, semicolon or tab; outside comma-separated files a
decimal comma is understood.
"""

import csv
import io
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError, unknown
from motionese.recordings.formats.csv_columns import (
    EPISODE,
    TIME,
    header,
    is_counter,
    label,
    named_column,
    seconds,
    split_unit,
)
from motionese.recordings.formats.csv_table import Table, numbers, read_table
from motionese.recordings.formats.written import write_file
from motionese.recordings.natural_order import natural
from motionese.recordings.recording import Episode, Recording


def read(path: Path, episode: str | None = None, time: str | None = None) -> Recording:
    """Read a table, or a folder of tables with the same columns.

    Args:
        path: The file, or a folder with one file an episode.
        episode: The column that names the episode; found by its name where left out.
        time: The column that holds the time; found by its name where left out.

    Raises:
        RecordingError: Not a table of numbers, or columns that are not there.
    """
    if not path.is_dir():
        return _file(path, episode, time, alone=True)
    # Some systems leave hidden files beside those of the user.
    files = sorted(path.glob("[!.]*.csv"), key=lambda f: natural(f.name))
    if not files:
        raise RecordingError(f"{path}: holds no .csv file")
    parts = [_file(file, episode, time, alone=False) for file in files]
    return replace(
        parts[0], source=path, episodes=tuple(e for p in parts for e in _as_first(p, parts[0]))
    )


def write(path: Path, recording: Recording) -> None:
    """Write one table: episode, time [s], and the channels; empty where nothing was observed.

    Raises:
        RecordingError: A channel is called as the columns of episode or time are, or `path`
            cannot be written.
    """
    taken = {EPISODE[0], TIME[0]} & {c.casefold() for c in recording.channels}
    if taken:
        raise RecordingError(f"{path}: a csv file has its own column '{taken.pop()}'; rename it")
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    times = [_times(e, recording.rate_hz) for e in recording.episodes]
    timed = all(t is not None for t in times)
    labels = [label(c, u) for c, u in zip(recording.channels, recording.units, strict=True)]
    table.writerow([EPISODE[0], *([f"{TIME[0]} [s]"] if timed else []), *labels])
    for episode, stamps in zip(recording.episodes, times, strict=True):
        columns: list[Iterable[str]] = [[episode.name] * len(episode.values)]
        if timed and stamps is not None:
            columns.append(map(repr, stamps.tolist()))
        for values, seen in zip(episode.values.T, episode.observed.T, strict=True):
            cells = zip(values.tolist(), seen.tolist(), strict=True)
            columns.append(repr(v) if s else "" for v, s in cells)
        table.writerows(zip(*columns, strict=True))
    write_file(path, text.getvalue().encode())


def _times(episode: Episode, rate_hz: float | None) -> Float[ndarray, " T"] | None:
    if episode.times is None and rate_hz is not None:
        return np.arange(len(episode.values)) / rate_hz
    return episode.times


def _file(path: Path, episode: str | None, time: str | None, *, alone: bool) -> Recording:
    table = read_table(path)
    names = header(path, table.header)
    by_name = named_column(path, names, episode, EPISODE)
    by_time = named_column(path, names, time, TIME)
    if by_name is not None and by_name == by_time:
        raise RecordingError(
            f"{path}: column '{names[by_name]}' cannot be episode and time at once"
        )
    columns = _columns(table, names, by_name, by_time, alone)
    times = None if by_time is None else columns.pop(by_time) * seconds(names[by_time])
    split = [split_unit(names[c]) for c in columns]
    if not split:
        raise RecordingError(f"{path}: no column holds numbers to learn from")
    channels = tuple(name for name, _ in split)
    values = np.stack(list(columns.values()), axis=1)
    observed = np.stack([table.filled(c) for c in columns], axis=1)
    episodes = tuple(
        Episode(name, _rising(table, times, rows, name), values[rows], observed[rows])
        for name, rows in _episodes(table, by_name, alone)
    )
    usual = tuple(c for c in channels if not is_counter(c))
    units = tuple(unit for _, unit in split)
    return Recording(path, channels, units, {}, None, episodes, usual or channels)


def _columns(
    table: Table, names: Sequence[str], by_name: int | None, by_time: int | None, alone: bool
) -> dict[int, Float[ndarray, " T"]]:
    """Return the columns that hold numbers; text is left out where it cannot name the episodes."""
    columns: dict[int, Float[ndarray, " T"]] = {}
    for column, name in enumerate(names):
        if not name or column == by_name:
            continue
        values = numbers(table, column, name)
        if values is not None:
            columns[column] = values
        elif column == by_time or (by_name is None and alone):
            raise RecordingError(
                f"{table.path}: column '{name}' holds text, not numbers"
                + ("" if column == by_time else f"; if it names the episodes: --episode {name}")
            )
    return columns


def _episodes(table: Table, by_name: int | None, alone: bool) -> list[tuple[str, slice]]:
    """Return the name of every episode with its rows, which must stand together."""
    stem = table.path.stem
    if by_name is None:
        return [(stem, slice(0, len(table.lines)))]
    cells = table.columns[by_name]
    starts = [i for i, cell in enumerate(cells) if i == 0 or cell != cells[i - 1]]
    met: set[str] = set()
    for i in starts:
        if not cells[i]:
            raise RecordingError(f"{table.where(i)}: the episode's name is missing")
        if cells[i] in met:
            raise RecordingError(
                f"{table.where(i)}: rows of episode '{cells[i]}' go on after those of another; "
                "sort the file by episode"
            )
        met.add(cells[i])
    spans = zip(starts, [*starts[1:], len(cells)], strict=True)
    return [(cells[a] if alone else f"{stem}/{cells[a]}", slice(a, b)) for a, b in spans]


def _rising(
    table: Table, times: Float[ndarray, " N"] | None, rows: slice, name: str
) -> Float[ndarray, " T"] | None:
    if times is None:
        return None
    here = times[rows]
    wrong = np.flatnonzero(~np.isfinite(here))
    if len(wrong):
        raise RecordingError(
            f"{table.where(rows.start + int(wrong[0]))}: episode '{name}' has a row without a time"
        )
    back = np.flatnonzero(np.diff(here) <= 0)
    if len(back):
        raise RecordingError(
            f"{table.where(rows.start + int(back[0]) + 1)}: time must rise inside episode "
            f"'{name}', got {here[back[0] + 1]:g} s after {here[back[0]]:g} s"
        )
    return here


def _as_first(part: Recording, first: Recording) -> Sequence[Episode]:
    """Return a file's episodes with their columns in the order of the folder's first file."""
    if part.channels == first.channels and part.units == first.units:
        return part.episodes
    for name in (*first.channels, *part.channels):
        if name not in part.channels:
            raise RecordingError(f"{part.source}: {unknown('channel', name, part.channels)}")
        if name not in first.channels:
            raise RecordingError(f"{first.source}: {unknown('channel', name, first.channels)}")
    order = [part.channels.index(c) for c in first.channels]
    for name, was, here in zip(
        first.channels, first.units, [part.units[i] for i in order], strict=True
    ):
        if was != here:
            raise RecordingError(
                f"{part.source}: channel '{name}' is in [{here}], "
                f"in {first.source.name} it is in [{was}]"
            )
    return [
        replace(e, values=e.values[:, order], observed=e.observed[:, order]) for e in part.episodes
    ]
