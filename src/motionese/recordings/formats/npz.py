"""The project's own file: an .npz with JSON beside the arrays; the same content, the same bytes."""

import io
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import BaseModel, ConfigDict, ValidationError, model_validator

from motionese.errors import RecordingError, SettingError
from motionese.faults import described
from motionese.recordings.formats.conventions import UNREADABLE, why
from motionese.recordings.formats.npz_flat import read_flat
from motionese.recordings.formats.writing import write_file
from motionese.recordings.nature import judged
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.stored import StoredRecording
from motionese.recordings.told_rate import as_timed

FORMAT, VERSION = "motionese-motions", 1
METADATA = "metadata"
SHARED = ("channels", "units", "ranges", "rate_hz", "usual", "binary", "held_out")
"""What the metadata tell just as a recording does."""


class Metadata(BaseModel):
    """What the file says of its arrays `values_i`, `observed_i` and, where given, `times_i`."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    channels: tuple[str, ...]
    units: tuple[str, ...]
    ranges: Mapping[str, tuple[float, float]]
    rate_hz: float | None
    usual: tuple[str, ...]
    episodes: tuple[str, ...]
    binary: Mapping[str, tuple[float, float]] = {}
    held_out: tuple[str, ...] = ()
    format: str = FORMAT
    version: int = VERSION

    @model_validator(mode="after")
    def _consistent(self) -> "Metadata":
        if len(self.units) != len(self.channels):
            raise ValueError(f"{len(self.channels)} channels need as many units, got {self.units}")
        if strange := {*self.usual, *self.ranges, *self.binary} - {*self.channels}:
            raise ValueError(f"there is no channel '{min(strange)}'")
        if strange := {*self.held_out} - {*self.episodes}:
            raise ValueError(f"there is no episode '{min(strange)}'")
        if self.rate_hz is not None and not 0 < self.rate_hz < math.inf:
            raise ValueError(f"a rate must be finite and > 0, got {self.rate_hz}")
        for name, (low, high) in (*self.ranges.items(), *self.binary.items()):
            if not -math.inf < low < high < math.inf:
                raise ValueError(f"channel '{name}' has no range from {low} to {high}")
        return self


def read(path: Path, columns: Sequence[str] | None = None) -> Recording:
    """Read a file that `write` wrote, or any archive of arrays whose `columns` may be named."""
    try:
        # NumPy leaves open what it opened itself and could not read.
        with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
            if METADATA not in file.files:
                return judged(read_flat(path, file, columns))
            if columns is not None:
                raise SettingError(f"{path}: its channels have names; --columns is for bare arrays")
            return as_timed(_stored(path, file).whole())
    except UNREADABLE as error:
        raise RecordingError(f"{path}: not a whole archive of arrays: {why(error)}") from error


def stored(path: Path) -> StoredRecording:
    """Open a file that `write` wrote, whose episodes are read one at a time."""
    try:
        file = np.load(path, allow_pickle=False)
        if METADATA in getattr(file, "files", ()):
            return _stored(path, file)
    except UNREADABLE as error:
        raise RecordingError(f"{path}: not a whole archive of arrays: {why(error)}") from error
    raise RecordingError(
        f"{path}: of archives, those that motionese wrote can be left where they are (--stored), "
        "which hold an array an episode; this is another"
    )


def _stored(path: Path, file: Any) -> StoredRecording:
    metadata = _metadata(path, file)
    nothing = np.empty((0, len(metadata.channels)))
    told = metadata.model_dump(include={*SHARED})
    episodes = tuple(Episode.whole(name, nothing) for name in metadata.episodes)

    def episode(i: int) -> Episode:
        try:
            return _episode(path, file, i, metadata.episodes[i], len(metadata.channels))
        except UNREADABLE as error:
            raise RecordingError(f"{path}: not a whole archive of arrays: {why(error)}") from error

    return StoredRecording(Recording(source=path, episodes=episodes, **told), episode)


def write(path: Path, recording: Recording) -> None:
    """Write a recording with all that it holds."""
    told = {name: getattr(recording, name) for name in SHARED}
    metadata = Metadata(**told, episodes=tuple(e.name for e in recording.episodes))
    arrays: dict[str, Any] = {METADATA: np.array(metadata.model_dump_json())}
    for i, episode in enumerate(recording.episodes):
        arrays |= {f"values_{i}": episode.values, f"observed_{i}": episode.observed}
        if episode.times is not None:
            arrays[f"times_{i}"] = episode.times
    content = io.BytesIO()
    np.savez_compressed(content, **arrays)
    write_file(path, content.getvalue())


def _metadata(path: Path, file: Any) -> Metadata:
    table = json.loads(str(file[METADATA]))
    if not isinstance(table, dict) or table.get("format") != FORMAT:
        raise RecordingError(f"{path}: an .npz file, but not of motions that motionese wrote")
    if table.get("version") != VERSION:
        raise RecordingError(
            f"{path}: written in format version {table.get('version')}, "
            f"this motionese reads version {VERSION}; a newer motionese may read it"
        )
    try:
        return Metadata.model_validate_json(str(file[METADATA]))
    except ValidationError as error:
        raise RecordingError(f"{path}: its metadata are damaged: {described(error)}") from error


def _episode(path: Path, file: Any, i: int, name: str, width: int) -> Episode:
    values, observed = file[f"values_{i}"], file[f"observed_{i}"]
    times = file.get(f"times_{i}")
    for what, array, dtype, shape in (
        ("values", values, np.float64, (len(values), width)),
        ("mask", observed, np.bool_, (len(values), width)),
        ("times", times, np.float64, (len(values),)),
    ):
        if array is not None and (array.dtype != dtype or array.shape != shape):
            raise RecordingError(
                f"{path}: the {what} of episode '{name}' should be {np.dtype(dtype)} of shape "
                f"{shape}, got {array.dtype} of shape {array.shape}"
            )
    return Episode(name, times, values, observed)
