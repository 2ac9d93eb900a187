"""Writing a table of text: episode, time, and the channels."""

import csv
import io
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.formats.csv_columns import EPISODE, TIME, label
from motionese.recordings.formats.written import write_file
from motionese.recordings.recording import Episode, Recording


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
