"""robomimic's HDF5: `data/demo_0/obs/…`, one group a demonstration.

Channels are the floating-point datasets [T] and [T, n] of `obs` and of the demonstration itself
(`actions`, `states`, `rewards`), named KEY or KEY_0, KEY_1, …; images are left alone. robomimic
names no columns: a dataset that we wrote says in its attributes `names` and `units` what they are.
"""

import json
import subprocess
import sys
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from motionese.errors import RecordingError
from motionese.recordings.formats.conventions import WIDEST, imported, natural, strings, why
from motionese.recordings.formats.writing import check_even_and_whole, next_rows, write_file
from motionese.recordings.rate import FASTEST_HZ
from motionese.recordings.recording import Episode, Recording

DERIVED = "derived_from"
"""Attribute of a dataset that is computed from another one, so that reading leaves it out."""

_NO_ENVIRONMENT = {"env_name": "recording", "type": 2}
"""robomimic asks for a kind of environment (2: gym) even where none is ever made."""
SECONDS = 30.0
"""The longest `_WALK`: one over thousands of demonstrations takes a few."""
_WALK = """
import sys, h5py
from contextlib import suppress
def visit(name, item):
    for key in item.attrs:
        with suppress(Exception):
            item.attrs[key]
with h5py.File(sys.argv[1], "r") as file:
    file.visititems(visit)
"""


class _Columns(NamedTuple):
    """The channels of one dataset, which has the same columns in every demonstration."""

    dataset: str
    names: tuple[str, ...]
    units: tuple[str, ...]


def read(path: Path) -> Recording:
    """Read the demonstrations of a robomimic file, in natural order, whatever its masks say.

    The rate is `control_freq` of the environment where the file has it. Observations are usual;
    actions where there are none.
    """
    h5py = imported("h5py", "hdf5", "reading robomimic's HDF5")
    _check_walkable(path)
    try:
        with h5py.File(path, "r") as file:
            return _recording(path, file)
    except (OSError, RuntimeError, LookupError, TypeError, ValueError, MemoryError) as error:
        # What h5py raises depends on which byte is damaged.
        raise RecordingError(
            f"{path}: not an HDF5 file, cut short, or damaged ({why(error)})"
        ) from error


def write(path: Path, recording: Recording) -> None:
    """Write the recording as demonstrations with one observation key, `state` [T, D].

    `actions` are the next row's state (the last row its own), which is what a learner imitates;
    `rewards` are 0 and `dones` 1 in the last row. No train and valid masks are made up. Gaps and
    uneven times are refused.
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
    write_file(path, content.getvalue())


def _check_walkable(path: Path) -> None:
    """Let a child process walk over the file's groups and attributes before we do.

    The HDF5 library crashes or hangs on damaged files: of those with a few random bytes changed
    about one in a hundred takes the process down or keeps it for ever, nearly always in an
    attribute of variable length. What the walk merely refuses is left to the reading.
    """
    try:
        command = [sys.executable, "-P", "-c", _WALK, str(path)]
        walk = subprocess.run(command, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise RecordingError(f"{path}: damaged: HDF5 does not get through it") from error
    if walk.returncode < 0:
        raise RecordingError(f"{path}: damaged: HDF5 crashes on it (signal {-walk.returncode})")


def _recording(path: Path, file: Any) -> Recording:
    data = file.get("data")
    groups = [key for key in data if _is_group(data[key])] if _is_group(data) else []
    if not (demos := sorted(groups, key=natural)):
        raise RecordingError(
            f"{path}: no demonstrations: robomimic's HDF5 has groups data/demo_0, data/demo_1, …; "
            f"here are: {', '.join(file) or 'none'}"
        )
    columns = tuple(_columns(data[demos[0]]))
    if not columns:
        raise RecordingError(
            f"{path}: '{demos[0]}' has no floating-point datasets of shape [T] or [T, n]"
        )
    observed = [c for c in columns if c.dataset.startswith("obs/")]
    usual = observed or [c for c in columns if c.dataset == "actions"] or columns
    return Recording(
        source=path,
        channels=tuple(n for c in columns for n in c.names),
        units=tuple(u for c in columns for u in c.units),
        ranges={},
        rate_hz=_rate(data.attrs.get("env_args")),
        episodes=tuple(_episode(path, data[demo], columns) for demo in demos),
        usual=tuple(n for c in usual for n in c.names),
    )


def _columns(demo: Any) -> Iterator[_Columns]:
    paths: list[str] = []
    if _is_group(demo.get("obs")):
        demo["obs"].visit(lambda key: paths.append(f"obs/{key}"))
    paths += [key for key in demo if key != "obs"]
    for name in paths:
        dataset = demo[name]
        if not (width := _width(dataset)) or DERIVED in dataset.attrs:
            continue
        named, units = (strings(_json(dataset.attrs.get(a)), width) for a in ("names", "units"))
        label = name.removeprefix("obs/")
        plain = (label,) if dataset.ndim == 1 else tuple(f"{label}_{i}" for i in range(width))
        yield _Columns(name, named or plain, units or ("",) * width)


def _is_group(item: Any) -> bool:
    return hasattr(item, "keys")


def _width(item: Any) -> int:
    """Return how many columns a dataset of numbers [T] or [T, n] has; 0 for anything else."""
    if not hasattr(item, "dtype") or item.dtype.kind != "f" or item.ndim not in {1, 2}:
        return 0
    width = 1 if item.ndim == 1 else int(item.shape[1])
    return width if width <= WIDEST else 0


def _episode(path: Path, demo: Any, columns: tuple[_Columns, ...]) -> Episode:
    own_name = demo.name.rpartition("/")[2]
    where = f"{path}: '{own_name}'"
    rows = {}
    for column in columns:
        dataset, width = demo.get(column.dataset), len(column.names)
        if _width(dataset) != width:
            raise RecordingError(
                f"{where} has no dataset {column.dataset} of {width} columns, "
                f"which the first demonstration has"
            )
        rows[column.dataset] = len(dataset)
    told = demo.attrs.get("num_samples")
    if isinstance(told, int | np.integer):
        rows["its attribute num_samples"] = int(told)
    first, *others = rows.items()
    for what, count in others:
        if count != first[1]:
            raise RecordingError(
                f"{where}: {first[0]} has {first[1]} rows, {what} {count}; they must agree"
            )
    tables = [np.asarray(demo[c.dataset][()]).reshape(-1, len(c.names)) for c in columns]
    values = np.concatenate(tables, axis=1, dtype=np.float64)
    name = demo.attrs.get("name")
    return Episode.whole(name if isinstance(name, str) else own_name, values)


def _rate(env_args: Any) -> float | None:
    """Return the control rate [Hz] that the environment's arguments tell."""
    told = _json(env_args)
    for key in ("env_kwargs", "control_freq"):
        told = told.get(key) if isinstance(told, dict) else None
    if isinstance(told, int | float) and 0 < told <= FASTEST_HZ:
        return float(told)
    return None


def _json(text: Any) -> Any:
    try:
        return json.loads(text)
    except (TypeError, ValueError, RecursionError):
        return None


def _write_demo(demo: Any, episode: Episode, recording: Recording) -> None:
    rows = len(episode.values)
    demo.attrs.update(num_samples=rows, name=episode.name)
    state = demo.create_dataset("obs/state", data=episode.values)
    state.attrs.update(names=json.dumps(recording.channels), units=json.dumps(recording.units))
    derived = {
        "actions": next_rows(episode.values),
        "rewards": np.zeros(rows),
        "dones": (np.arange(rows) == rows - 1).astype(np.int64),
    }
    for name, values in derived.items():
        demo.create_dataset(name, data=values).attrs[DERIVED] = "obs/state"
