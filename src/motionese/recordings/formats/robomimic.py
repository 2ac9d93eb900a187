"""robomimic's HDF5: `data/demo_0/obs/…`, one group a demonstration, and sets of them in `mask`.

The demonstration's own datasets (`actions`, `states`, `rewards`) are channels as well. The files
of robosuite, LIBERO and Isaac Lab are of this layout.
"""

import json
from dataclasses import replace
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from motionese.recordings.formats.conventions import imported, natural
from motionese.recordings.formats.hdf5_columns import (
    DERIVED,
    ROWS,
    is_dataset,
    is_group,
    paths,
    rate_in,
    read_json,
    stored_in,
)
from motionese.recordings.formats.set_apart import TESTING, TRAINING, set_apart
from motionese.recordings.formats.writing import check_even_and_whole, next_rows, write_file
from motionese.recordings.recording import Episode, Recording
from motionese.recordings.stored import StoredRecording

WHAT = "groups data/demo_0, data/demo_1, …"
OBSERVED, MASKS = "obs", "mask"
_NO_ENVIRONMENT = {"env_name": "recording", "type": 2}
"""robomimic asks for a kind of environment (2: gym) even where none is ever made."""


def holds(file: Any) -> bool:
    """Tell whether a file is of this layout."""
    return bool(_demos(file))


def recording(path: Path, file: Any) -> Recording:
    """Return the demonstrations of a file, all of them read."""
    return stored(path, file).whole()


def stored(path: Path, file: Any) -> StoredRecording:
    """Return the demonstrations, in natural order; those that masks set apart are held out.

    The rate is `control_freq` of the environment where the file has it.
    """
    data, demos = file["data"], _demos(file)
    first = data[demos[0]]
    inside = [f"{OBSERVED}/{key}" for key in paths(first.get(OBSERVED))]
    told = read_json(data.attrs.get("env_args"))
    found = stored_in(
        path,
        [(_name(data[demo], demo), data[demo]) for demo in demos],
        [*inside, *(key for key in first if key != OBSERVED)],
        OBSERVED,
        rate_in(told.get("env_kwargs")) if isinstance(told, dict) else None,
    )
    held_out, findings = set_apart(path, _masks(file), demos)
    outline = found.outline
    names = tuple(outline.episodes[demos.index(demo)].name for demo in held_out)
    return replace(found, outline=replace(outline, held_out=names).found(*findings))


def write(path: Path, recording: Recording) -> None:
    """Write the recording as demonstrations with one observation key, `state` [T, D].

    `actions` are the next row's state (the last row its own), which is what a learner imitates;
    `rewards` are 0 and `dones` 1 in the last row. Masks are written where episodes are set apart.
    Gaps and uneven times are refused.
    """
    h5py = imported("h5py", "hdf5", "writing robomimic's HDF5")
    check_even_and_whole(path, recording, "robomimic's HDF5")
    content = BytesIO()
    with h5py.File(content, "w") as file:
        data = file.create_group("data")
        data.attrs["total"] = sum(len(e.values) for e in recording.episodes)
        rate = {} if recording.rate_hz is None else {"control_freq": recording.rate_hz}
        data.attrs["env_args"] = json.dumps({**_NO_ENVIRONMENT, "env_kwargs": rate})
        for i, episode in enumerate(recording.episodes):
            _write_demo(data.create_group(f"demo_{i}"), episode, recording)
        for mask, own in _parts(recording).items():
            file[f"{MASKS}/{mask}"] = np.array([f"demo_{i}".encode() for i in own])
    write_file(path, content.getvalue())


def _demos(file: Any) -> list[str]:
    data = file.get("data")
    groups = [key for key in data if is_group(data[key])] if is_group(data) else []
    return sorted(groups, key=natural)


def _name(demo: Any, key: str) -> str:
    told = demo.attrs.get("name")
    return told if isinstance(told, str) else key


def _masks(file: Any) -> dict[str, list[str]]:
    """Return the names of the demonstrations in every mask."""
    masks = file.get(MASKS)
    members = {
        key: np.ravel(masks[key][()]).tolist()
        for key in (masks if is_group(masks) else ())
        if is_dataset(masks[key])
    }
    return {
        key: [
            name.decode(errors="replace") if isinstance(name, bytes) else str(name)
            for name in names
        ]
        for key, names in members.items()
    }


def _parts(recording: Recording) -> dict[str, list[int]]:
    """Return which episodes are in which mask; no masks where none is set apart."""
    apart = [i for i, e in enumerate(recording.episodes) if e.name in recording.held_out]
    learned = [i for i in range(len(recording.episodes)) if i not in apart]
    return {TRAINING: learned, TESTING[0]: apart} if apart else {}


def _write_demo(demo: Any, episode: Episode, recording: Recording) -> None:
    rows = len(episode.values)
    demo.attrs.update({ROWS: rows, "name": episode.name})
    state = demo.create_dataset("obs/state", data=episode.values)
    state.attrs.update(names=json.dumps(recording.channels), units=json.dumps(recording.units))
    derived = {
        "actions": next_rows(episode.values),
        "rewards": np.zeros(rows),
        "dones": (np.arange(rows) == rows - 1).astype(np.int64),
    }
    for name, values in derived.items():
        demo.create_dataset(name, data=values).attrs[DERIVED] = "obs/state"
