"""Tables of text: one file with a column that names the episode, or a folder with one file each.

A first line names the columns, as "shoulder [rad]" where the unit is known, or a row of units
stands below it; lines of words may stand above it, and without it the columns are numbered. An
empty cell is a value that was not observed. Separated by comma, semicolon, tab, or blanks; outside
comma-separated files a decimal comma is understood.
"""

import csv
import io
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np

from motionese.errors import RecordingError
from motionese.recordings.finding import merged
from motionese.recordings.formats import csv_episodes, csv_times
from motionese.recordings.formats.csv_columns import channels_of, matrix
from motionese.recordings.formats.csv_folder import SUFFIXES, SURE, patterns, tables_in
from motionese.recordings.formats.csv_names import (
    EPISODE,
    TIME,
    folded_name,
    is_measured,
    label,
    named_column,
    split_unit,
)
from motionese.recordings.formats.csv_table import Table, read_table
from motionese.recordings.formats.writing import write_file
from motionese.recordings.recording import Episode, Recording

__all__ = ["SUFFIXES", "SURE", "patterns", "read", "write"]


def read(
    path: Path,
    episode: str | None = None,
    time: str | None = None,
    columns: Sequence[str] | None = None,
) -> Recording:
    """Read a table, or a folder of tables with the same columns, one file an episode.

    The columns that name the `episode` and hold the `time` are found if they are not given;
    `columns` names those of a table without a header.
    """

    def is_text(name: str) -> bool:
        mine = folded_name(name) in EPISODE or csv_episodes.may_name(name)
        return mine or episode in {name, split_unit(name)[0]}

    if not path.is_dir():
        return _recording(path, [read_table(path, columns, is_text)], episode, time)
    tables, findings = tables_in(path, columns, is_text)
    return _recording(path, tables, episode, time).found(*findings)


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
    labels = [label(name, unit) for name, unit in named]
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


# What is absurd is told of further on, not here: differences of huge values may overflow.
@np.errstate(over="ignore", invalid="ignore")
def _recording(
    path: Path, tables: Sequence[Table], episode: str | None, time: str | None
) -> Recording:
    """Return what tables with the same columns hold."""
    first, alone = tables[0], not path.is_dir()
    by_name = named_column(first.path, first.header, episode, EPISODE)
    by_time, findings = csv_times.time_columns(tables, time)
    if by_name is not None and by_name in by_time:
        raise RecordingError(
            f"{path}: column '{first.header[by_name]}' cannot be episode and time at once"
        )
    stamps, told = csv_times.times(tables, by_time)
    findings += told
    if by_name is None and alone:
        by_name, told = csv_episodes.by_nature(first, by_time, stamps[0] if stamps else None)
        findings += told
    channels, told = channels_of(
        tables, (by_name, *by_time), named=by_name is not None or not alone
    )
    if not channels:
        raise RecordingError(f"{path}: no column holds numbers to learn from")
    episodes: list[Episode] = []
    for number, table in enumerate(tables):
        values, observed = matrix(table, number, channels)
        here = None if stamps is None else stamps[number]
        parts, done = csv_episodes.parts_of(table, by_name, here, alone=alone)
        episodes += [Episode(p.name, p.times, values[p.rows], observed[p.rows]) for p in parts]
        told += [*table.findings, *done]
    names = tuple(c.name for c in channels)
    return Recording(
        path,
        names,
        tuple(c.unit for c in channels),
        {},
        None,
        tuple(episodes),
        tuple(filter(is_measured, names)) or names,
        binary={c.name: (0.0, 1.0) for c in channels if c.binary},
        findings=merged([*findings, *told]),
    )
