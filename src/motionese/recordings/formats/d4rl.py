"""D4RL's HDF5: all episodes one after another in `observations` [N, n], `actions`, `rewards`, ….

An episode ends where `terminals` or `timeouts` say so.
"""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.flat_episodes import cuts
from motionese.recordings.formats.hdf5_columns import is_dataset, paths, rate_in, recording_of
from motionese.recordings.recording import Recording

WHAT = "datasets observations and terminals"
OBSERVED, INFOS = "observations", "infos"
ENDS = ("terminals", "timeouts")


def holds(file: Any) -> bool:
    """Tell whether a file is of this layout."""
    return is_dataset(file.get(OBSERVED))


def recording(path: Path, file: Any) -> Recording:
    """Return the episodes, called by their numbers."""
    infos = [f"{INFOS}/{key}" for key in paths(file.get(INFOS))]
    datasets = [*(key for key in file if key not in ENDS), *infos]
    whole = recording_of(path, [("", file)], datasets, OBSERVED, rate_in(file.attrs))
    (rows,) = whole.episodes
    ends = [np.asarray(file[key][()]) if is_dataset(file.get(key)) else None for key in ENDS]
    for key, marks in zip(ENDS, ends, strict=True):
        if marks is not None and marks.shape not in {(len(rows.values),), (len(rows.values), 1)}:
            raise RecordingError(
                f"{path}: {OBSERVED} has {len(rows.values)} rows, {key} the shape {marks.shape}; "
                "they must agree"
            )
    parts = cuts(ends[0], ends[1], len(rows.values))
    episodes = [replace(rows.part(part), name=f"episode_{i}") for i, part in enumerate(parts)]
    if not any(marks is not None and marks.any() for marks in ends):
        what = (
            f"neither {' nor '.join(ENDS)} mark an end: all {len(rows.values)} rows are one episode"
        )
        whole = whole.found(Finding("time", path, what))
    return replace(whole, episodes=tuple(episodes))
