"""LeRobotDataset v3.0, v2.1 and v2.0, read with pyarrow alone: no lerobot, no video decoded."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.formats.conventions import imported, times_unless_even, why
from motionese.recordings.formats.lerobot_features import (
    ACTION,
    STATE,
    Feature,
    Info,
    features_of,
    features_told,
    read_info,
)
from motionese.recordings.formats.lerobot_writing import write
from motionese.recordings.formats.set_apart import set_apart
from motionese.recordings.nature import runs
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.stored import StoredRecording
from motionese.recordings.told_rate import as_timed

__all__ = ["read", "stored", "write"]


class _Rows(NamedTuple):
    """All rows of the dataset, sorted by episode and frame."""

    values: Float[ndarray, "N D"]
    episode: Int[ndarray, " N"]
    frame: Int[ndarray, " N"]
    times: Float[ndarray, " N"]


class _Part(NamedTuple):
    """Where an episode lies: in which file, from which row on, and how many rows."""

    episode: int
    file: Path
    first: int
    rows: int


def read(path: Path) -> Recording:
    """Read the features of numbers of a LeRobotDataset; images and videos are left alone.

    Channels are named as in `lerobot_features.features_of`. Those of `observation.state` are
    usual; of `action` where there is no state; else all. Splits for testing are held out.
    """
    info, features = _told(path)
    rows = _read_rows(path, features)
    outline, named = _outline(path, info, features, rows.episode)
    return as_timed(replace(outline, episodes=tuple(_episodes(path, info, rows, named))))


def stored(path: Path) -> StoredRecording:
    """Open a LeRobotDataset, whose episodes are read one at a time, by the row groups of files."""
    info, features = _told(path)
    parts = _parts(path)
    indices = np.concatenate([np.full(part.rows, part.episode) for part in parts])
    outline, named = _outline(path, info, features, indices)
    by_episode = {part.episode: part for part in parts}
    if len(by_episode) < len(parts):
        raise RecordingError(
            f"{path}: the rows of an episode lie apart, so that it cannot be left where it is "
            "(--stored)"
        )

    def episode(i: int) -> Episode:
        index = list(named)[i]
        rows = _sorted_rows(path, features, [_columns(by_episode[index], features)])
        (found,) = _episodes(path, info, rows, {index: named[index]})
        return found

    return StoredRecording(outline, episode)


def _told(path: Path) -> tuple[Info, tuple[Feature, ...]]:
    """Return what a dataset tells of itself, and its features of numbers."""
    info = read_info(path)
    if not (features := features_of(info)):
        raise RecordingError(
            f"{path}: no feature of numbers of shape [n]; "
            f"there are: {', '.join(info.features) or 'none'}"
        )
    return info, features


def _outline(
    path: Path, info: Info, features: tuple[Feature, ...], episode: Int[ndarray, " N"]
) -> tuple[Recording, dict[int, str]]:
    """Return the recording, its episodes without rows, and their names by their index.

    Args:
        path: The dataset.
        info: What it tells.
        features: Of numbers.
        episode: The index of every row's episode.
    """
    found = {"total_frames": len(episode), "total_episodes": len(np.unique(episode))}
    for key, count in found.items():
        if (told := getattr(info, key)) not in {None, count}:
            raise RecordingError(
                f"{path}: meta/info.json tells {told} {key}, the files in data hold {count}; "
                f"is the download complete?"
            )
    by_key = {f.key: f.channels for f in features}
    channels = tuple(name for f in features for name in f.channels)
    named = _names(info, episode)
    held_out, findings = set_apart(path, _splits(info, named), tuple(named.values()))
    nothing = np.empty((0, len(channels)))
    outline = Recording(
        source=path,
        channels=channels,
        units=tuple(unit for f in features for unit in f.units),
        ranges={},
        rate_hz=info.fps,
        episodes=tuple(Episode.whole(name, nothing) for name in named.values()),
        usual=by_key.get(STATE) or by_key.get(ACTION) or channels,
        held_out=held_out,
        findings=(*features_told(path, info), *findings),
    )
    return outline, named


def _parts(path: Path) -> list[_Part]:
    """Return where the rows of every episode lie that follow one another in a file."""
    parts = []
    for file in _files(path):
        whole = _matrix(file, _table(file, ["episode_index"]), "episode_index", 1)
        episode = _integers(path, "episode_index", whole)
        starts = runs(episode).tolist()
        for start, end in zip(starts, [*starts[1:], len(episode)], strict=True):
            parts.append(_Part(int(episode[start]), file, start, end - start))
    return parts


def _columns(part: _Part, features: tuple[Feature, ...]) -> dict[str, Float[ndarray, "N n"]]:
    """Return the columns of one part of a file."""
    widths = _widths(features)
    table = _table(part.file, list(widths), range(part.first, part.first + part.rows))
    return {key: _matrix(part.file, table, key, width) for key, width in widths.items()}


def _files(path: Path) -> list[Path]:
    if not (files := sorted((path / "data").glob("*/*.parquet"))):
        raise RecordingError(f"{path}: no data/chunk-…/*.parquet; is the download complete?")
    return files


def _widths(features: tuple[Feature, ...]) -> dict[str, int]:
    """Return how many numbers a row of every column has that is read."""
    widths = {f.key: len(f.channels) for f in features}
    return widths | {"episode_index": 1, "frame_index": 1, "timestamp": 1}


def _read_rows(path: Path, features: tuple[Feature, ...]) -> _Rows:
    widths, parts = _widths(features), []
    for file in _files(path):
        table = _table(file, list(widths))
        parts.append({key: _matrix(file, table, key, width) for key, width in widths.items()})
    return _sorted_rows(path, features, parts)


def _sorted_rows(
    path: Path, features: tuple[Feature, ...], parts: Sequence[Mapping[str, ndarray]]
) -> _Rows:
    whole = {key: np.concatenate([part[key] for part in parts]) for key in parts[0]}
    values = np.concatenate([whole[f.key] for f in features], axis=1)
    episode, frame = (_integers(path, key, whole[key]) for key in ("episode_index", "frame_index"))
    order = np.lexsort((frame, episode))
    return _Rows(values[order], episode[order], frame[order], whole["timestamp"][order, 0])


def _table(file: Path, columns: list[str], rows: range | None = None) -> Any:
    """Return these columns of a parquet file and no others, which may be pictures; or some rows."""
    pyarrow = imported("pyarrow", "lerobot", "reading a LeRobotDataset")
    try:
        with import_module("pyarrow.parquet").ParquetFile(file) as parquet:
            missing = [key for key in columns if key not in parquet.schema_arrow.names]
            if missing:
                raise RecordingError(f"{file}: has no column '{missing[0]}'")
            if rows is None:
                return parquet.read(columns=columns)
            sizes = [parquet.metadata.row_group(i).num_rows for i in range(parquet.num_row_groups)]
            ends = np.cumsum(sizes)
            first, last = np.searchsorted(ends, [rows.start, rows.stop - 1], side="right").tolist()
            table = parquet.read_row_groups(list(range(first, last + 1)), columns=columns)
            return table.slice(rows.start - int(ends[first]) + sizes[first], len(rows))
    except (pyarrow.ArrowException, OSError, ValueError, MemoryError) as error:
        raise RecordingError(
            f"{file}: not a parquet file, cut short, or damaged ({why(error)})"
        ) from error


def _matrix(file: Path, table: Any, key: str, width: int) -> Float[ndarray, "N n"]:
    """Return a column of numbers, or of lists of `width` numbers, as an array."""
    from pyarrow import compute, types  # noqa: PLC0415

    def is_number(kind: Any) -> bool:
        return any(test(kind) for test in (types.is_floating, types.is_integer, types.is_boolean))

    cells = table.column(key).combine_chunks()
    nulls, lengths = cells.null_count, [1]
    if getattr(cells.type, "value_type", None) is not None and not is_number(cells.type):
        lengths = compute.unique(compute.list_value_length(cells)).drop_null().to_pylist()
        cells = cells.flatten()
        nulls += cells.null_count
    if not is_number(cells.type):
        raise RecordingError(f"{file}: column '{key}' holds {cells.type}, not numbers")
    if nulls:
        raise RecordingError(f"{file}: column '{key}' has {nulls} cells without a value (null)")
    if lengths not in ([], [width]):
        raise RecordingError(
            f"{file}: column '{key}' has {lengths} numbers in a row; info.json says {width}"
        )
    return np.asarray(cells.to_numpy(zero_copy_only=False), np.float64).reshape(-1, width)


def _integers(path: Path, key: str, column: Float[ndarray, "N 1"]) -> Int[ndarray, " N"]:
    if len(wrong := np.flatnonzero(~(np.abs(column[:, 0]) < 2**53))):
        raise RecordingError(f"{path}: column '{key}' holds {column[wrong[0], 0]:g}, no row number")
    return np.asarray(column[:, 0], dtype=np.int64)


def _names(info: Info, episode: Int[ndarray, " N"]) -> dict[int, str]:
    """Return the names of the episodes by their index."""
    told = dict(enumerate(info.episode_names))
    indices = np.unique(episode).tolist()
    return {index: told.get(index, f"episode_{index:06d}") for index in indices}


def _splits(info: Info, named: Mapping[int, str]) -> dict[str, list[str]]:
    """Return the names of the episodes in every split that is told as "FIRST:END"."""
    splits, found = info.splits if isinstance(info.splits, dict) else {}, {}
    # However far a split goes on behind the last episode, one that is missing is enough to tell.
    last = max(named, default=-1) + 1
    for part, told in splits.items():
        if span := re.fullmatch("([0-9]{1,18}):([0-9]{1,18})", str(told)):
            indices = range(int(span[1]), min(int(span[2]), last + 1))
            found[part] = [named.get(i, f"episode_{i:06d}") for i in indices]
    return found


def _episodes(path: Path, info: Info, rows: _Rows, named: Mapping[int, str]) -> Iterator[Episode]:
    indices, starts = np.unique(rows.episode, return_index=True)
    for index, start, end in zip(indices, starts, [*starts[1:], len(rows.episode)], strict=True):
        if len(wrong := np.flatnonzero(rows.frame[start:end] != np.arange(end - start))):
            raise RecordingError(
                f"{path}: episode {index}: frame {wrong[0]} is missing; "
                f"found frame_index {rows.frame[start + wrong[0]]} in its place"
            )
        times = times_unless_even(rows.times[start:end], info.fps)
        yield Episode.whole(named[index], rows.values[start:end], times)
