"""Writing robomimic's HDF5, so that its learners can be trained on our recordings."""

import json
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from motionese.errors import needs
from motionese.recordings.formats.even_rows import check_even_and_whole
from motionese.recordings.formats.next_row import next_rows
from motionese.recordings.formats.written import write_file
from motionese.recordings.recording import Episode, Recording

DERIVED = "derived_from"
"""Attribute of a dataset that is computed from another one, so that reading leaves it out."""

_NO_ENVIRONMENT = {"env_name": "recording", "type": 2}
"""robomimic asks for a kind of environment (2: gym) even where none is ever made."""


def write(path: Path, recording: Recording) -> None:
    """Write the recording as demonstrations with one observation key, `state` [T, D].

    `actions` are the next row's state (the last row its own), which is what a learner imitates;
    `rewards` are 0 and `dones` 1 in the last row. No train and valid masks are made up.

    Raises:
        RecordingError: Gaps or uneven times, which robomimic cannot hold.
        MissingPackageError: h5py is not installed.
    """
    try:
        import h5py  # noqa: PLC0415
    except ImportError as error:
        raise needs("h5py", "hdf5", "writing robomimic's HDF5") from error
    check_even_and_whole(path, recording, "robomimic's HDF5")
    content = BytesIO()
    with h5py.File(content, "w") as file:
        data = file.create_group("data")
        data.attrs["total"] = sum(len(e.values) for e in recording.episodes)
        rate = {} if recording.rate_hz is None else {"control_freq": recording.rate_hz}
        data.attrs["env_args"] = json.dumps({**_NO_ENVIRONMENT, "env_kwargs": rate})
        for i, episode in enumerate(recording.episodes):
            _write_demo(data.create_group(f"demo_{i}"), episode, recording)
    write_file(path, content.getvalue())


def _write_demo(demo: Any, episode: Episode, recording: Recording) -> None:
    rows = len(episode.values)
    demo.attrs["num_samples"] = rows
    demo.attrs["name"] = episode.name
    state = demo.create_dataset("obs/state", data=episode.values)
    state.attrs["names"] = json.dumps(recording.channels)
    state.attrs["units"] = json.dumps(recording.units)
    derived = {
        "actions": next_rows(episode.values),
        "rewards": np.zeros(rows),
        "dones": (np.arange(rows) == rows - 1).astype(np.int64),
    }
    for name, values in derived.items():
        demo.create_dataset(name, data=values).attrs[DERIVED] = "obs/state"
