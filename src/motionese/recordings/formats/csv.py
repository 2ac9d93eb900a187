"""Tables of text: one file with a column that names the episode, or a folder with one file each.

A first line names the columns, as "shoulder [rad]" where the unit is known; comments may stand
above it. An empty cell is a value that was not observed. Separated by comma, semicolon, tab, or
blanks; outside comma-separated files a decimal comma is understood.
"""

import csv
import io
import shlex
from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.errors import RecordingError, unknown
from motionese.recordings.formats import csv_columns
from motionese.recordings.formats.conventions import natural
from motionese.recordings.formats.csv_columns import EPISODE, TIME
from motionese.recordings.formats.csv_table import Table, read_table
from motionese.recordings.formats.writing import write_file
from motionese.recordings.recording import Episode, Recording

SUFFIXES = (".csv", ".tsv")
"""Of the files in a folder that are read; others may be notes."""


def read(path: Path, episode: str | None = None, time: str | None = None) -> Recording:
    """Read a table, or a folder of tables with the same columns, one file an episode.

    The columns that name the `episode` and hold the `time` are found by their names if not given.
    """
    if not path.is_dir():
        return _file(path, episode, time, alone=True)
    # Some systems leave hidden files beside those of the user.
    files = [file for file in path.glob("[!.]*") if file.suffix.lower() in SUFFIXES]
    if not files:
        raise RecordingError(f"{path}: holds no {' or '.join(SUFFIXES)} file")
    files.sort(key=lambda f: natural(f.name))
    parts = [_file(file, episode, time, alone=False) for file in files]
    episodes = tuple(e for p in parts for e in _as_first(p, parts[0]))
    return replace(parts[0], source=path, episodes=episodes)


def write(path: Path, recording: Recording) -> None:
    """Write one table: episode, time [s], and the channels; empty where nothing was observed.

    No channel may be called as the columns of episode or time are.
    """
    if taken := {EPISODE[0], TIME[0]} & {c.casefold() for c in recording.channels}:
        raise RecordingError(f"{path}: a csv file has its own column '{taken.pop()}'; rename it")
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    times = [e.times_at(recording.rate_hz) for e in recording.episodes]
    timed = all(t is not None for t in times)
    named = zip(recording.channels, recording.units, strict=True)
    labels = [csv_columns.label(name, unit) for name, unit in named]
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


def _file(path: Path, episode: str | None, time: str | None, *, alone: bool) -> Recording:
    table = read_table(path)
    names = csv_columns.header(path, table.header)
    by_name = csv_columns.named_column(path, names, episode, EPISODE)
    by_time = csv_columns.named_column(path, names, time, TIME)
    if by_name is not None and by_name == by_time:
        raise RecordingError(
            f"{path}: column '{names[by_name]}' cannot be episode and time at once"
        )
    may_name = alone and by_name is None
    columns = {
        i: found
        for i, name in enumerate(names)
        if name and i not in {by_name, by_time} and (found := _measured(table, i, may_name))
    }
    if not columns:
        raise RecordingError(f"{path}: no column holds numbers to learn from")
    channels, units = zip(*(csv_columns.split_unit(names[i]) for i in columns), strict=True)
    values, observed = (np.stack(kind, axis=1) for kind in zip(*columns.values(), strict=True))
    stamps = None if by_time is None else csv_columns.times(table, by_time)
    episodes = tuple(
        Episode(name, _rising(table, stamps, rows, name), values[rows], observed[rows])
        for name, rows in _episodes(table, by_name, alone)
    )
    usual = tuple(c for c in channels if csv_columns.is_measured(c))
    return Recording(path, channels, units, {}, None, episodes, usual or channels)


def _measured(
    table: Table, column: int, may_name: bool
) -> tuple[Float[ndarray, " T"], Bool[ndarray, " T"]] | None:
    """Return a column of numbers; None for text, unless it may be what names the episodes."""
    found = csv_columns.numbers(table, column)
    if found is not None or not may_name:
        return found
    name, words = table.header[column], {cell for cell in table.columns[column] if cell}
    if len(words) > 1:
        raise RecordingError(
            f"{table.path}: column '{name}' holds text such as '{min(words)[:40]}', not numbers; "
            f"if it names the episodes: --episode {shlex.quote(name)}, else take it out"
        )
    return None


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
    if len(wrong := np.flatnonzero(~np.isfinite(here))):
        raise RecordingError(
            f"{table.where(rows.start + int(wrong[0]))}: episode '{name}' has a row without a time"
        )
    if len(back := np.flatnonzero(np.diff(here) <= 0)):
        raise RecordingError(
            f"{table.where(rows.start + int(back[0]) + 1)}: time must rise inside episode "
            f"'{name}', got {here[back[0] + 1]:.12g} s after {here[back[0]]:.12g} s"
        )
    return here


def _as_first(part: Recording, first: Recording) -> Sequence[Episode]:
    """Return a file's episodes with their columns in the order of the folder's first file."""
    if part.channels == first.channels and part.units == first.units:
        return part.episodes
    for mine, other in ((part, first), (first, part)):
        for name in other.channels:
            if name not in mine.channels:
                raise RecordingError(f"{mine.source}: {unknown('channel', name, mine.channels)}")
    order = [part.channels.index(c) for c in first.channels]
    for i, name, was in zip(order, first.channels, first.units, strict=True):
        if was != (here := part.units[i]):
            raise RecordingError(
                f"{part.source}: channel '{name}' is in [{here}], "
                f"in {first.source.name} it is in [{was}]"
            )
    return part.map(lambda e: e.part(columns=order)).episodes
