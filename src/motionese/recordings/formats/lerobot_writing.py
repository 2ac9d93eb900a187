"""Writing a LeRobotDataset v3.0 with pyarrow alone, such that lerobot loads it."""

import json
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.formats.conventions import imported
from motionese.recordings.formats.lerobot_features import ACTION, BOOKKEEPING, STATE
from motionese.recordings.formats.writing import check_even_and_whole, new_folder, next_rows
from motionese.recordings.recording import Recording

_DATA = "data/chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
_TASK = "motion"
"""Every dataset names a task; a recording tells none."""
_QUANTILES = {"q01": 0.01, "q10": 0.1, "q50": 0.5, "q90": 0.9, "q99": 0.99}


def write(path: Path, recording: Recording) -> None:
    """Write the recording as a new folder that holds a LeRobotDataset v3.0.

    `observation.state` holds all channels in single precision, which is what lerobot's policies
    take; `action` is the next row's state (the last row its own), for a policy needs one. Gaps,
    uneven times and a rate that is no whole number are refused.
    """
    check_even_and_whole(path, recording, "a LeRobotDataset")
    rate = recording.rate_hz
    if rate is None or rate != round(rate):
        raise RecordingError(
            f"{path}: a LeRobotDataset has a whole number of frames per second, the recording "
            f"{'no known rate' if rate is None else f'{rate:g}'}: resample it to a whole rate"
        )
    starts = np.cumsum([0, *(len(e.values) for e in recording.episodes)]).tolist()
    episodes = [_columns(i, starts[i], e.values, rate) for i, e in enumerate(recording.episodes)]
    whole = {key: np.concatenate([e[key] for e in episodes]) for key in episodes[0]}
    with new_folder(path) as folder:
        _write_parquets(folder, whole, episodes)
        _write_json(folder / "meta" / "stats.json", {k: _statistics(v) for k, v in whole.items()})
        _write_json(folder / "meta" / "info.json", _info(recording, int(rate), starts[-1]))


def _columns(index: int, start: int, values: ndarray, rate_hz: float) -> dict[str, ndarray]:
    """Return the columns [T] and [T, D] of one episode, which begins at row `start` of all."""
    state = values.astype(np.float32)
    frame = np.arange(len(state))
    return {
        STATE: state,
        ACTION: next_rows(state),
        "timestamp": (frame / rate_hz).astype(np.float32),
        "frame_index": frame,
        "episode_index": np.full(len(state), index),
        "index": start + frame,
        "task_index": np.zeros(len(state), np.int64),
    }


def _info(recording: Recording, fps: int, frames: int) -> dict[str, Any]:
    vector = {"dtype": "float32", "shape": [len(recording.channels)]}
    named = {"names": list(recording.channels), "units": list(recording.units)}
    features: dict[str, dict[str, Any]] = {
        STATE: {**vector, **named},
        # Reading leaves out what is only computed from another feature.
        ACTION: {**vector, **named, "derived_from": STATE},
    }
    for key in BOOKKEEPING:
        dtype = "float32" if key == "timestamp" else "int64"
        features[key] = {"dtype": dtype, "shape": [1], "names": None}
    episodes = len(recording.episodes)
    return {
        "codebase_version": "v3.0",
        "robot_type": None,
        "total_episodes": episodes,
        "total_frames": frames,
        "total_tasks": 1,
        "chunks_size": 1000,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 200,
        "fps": fps,
        "splits": {"train": f"0:{episodes}"},
        "data_path": _DATA,
        "video_path": None,
        "features": features,
        "episode_names": [e.name for e in recording.episodes],
    }


def _statistics(values: ndarray) -> dict[str, list[Any]]:
    """Return what lerobot keeps of every feature, each a list over its columns."""
    table = values.reshape(len(values), -1)
    exact = table.astype(np.float64)
    return {
        "min": table.min(0).tolist(),
        "max": table.max(0).tolist(),
        "mean": exact.mean(0).tolist(),
        "std": exact.std(0).tolist(),
        "count": [len(table)],
        **{name: np.quantile(exact, q, axis=0).tolist() for name, q in _QUANTILES.items()},
    }


def _write_parquets(
    folder: Path, whole: dict[str, ndarray], episodes: list[dict[str, ndarray]]
) -> None:
    pa = imported("pyarrow", "lerobot", "writing a LeRobotDataset")
    pd = imported("pandas", "lerobot", "writing a LeRobotDataset")
    parquet = import_module("pyarrow.parquet")
    data = {key: pa.array(v) for key, v in whole.items() if v.ndim == 1}
    for key in (STATE, ACTION):
        cells = pa.array(whole[key].reshape(-1))
        # lerobot keeps a feature of shape [1] as plain numbers, not as lists of one.
        width = whole[key].shape[1]
        data[key] = cells if width == 1 else pa.FixedSizeListArray.from_arrays(cells, width)
    order = [STATE, ACTION, *BOOKKEEPING]
    tasks = pd.DataFrame({"task_index": [0]}, index=pd.Index([_TASK], name="task"))
    tables = {
        _DATA.format(chunk_index=0, file_index=0): pa.table({key: data[key] for key in order}),
        "meta/episodes/chunk-000/file-000.parquet": pa.Table.from_pylist(
            [_about(columns) for columns in episodes]
        ),
        "meta/tasks.parquet": pa.Table.from_pandas(tasks),
    }
    for name, table in tables.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        parquet.write_table(table, folder / name)


def _about(columns: dict[str, ndarray]) -> dict[str, Any]:
    """Return an episode's row of meta/episodes."""
    start, rows = int(columns["index"][0]), len(columns["index"])
    statistics = {
        f"stats/{key}/{what}": told
        for key, values in columns.items()
        for what, told in _statistics(values).items()
    }
    return {
        "episode_index": int(columns["episode_index"][0]),
        "tasks": [_TASK],
        "length": rows,
        "data/chunk_index": 0,
        "data/file_index": 0,
        "dataset_from_index": start,
        "dataset_to_index": start + rows,
        **statistics,
        "meta/episodes/chunk_index": 0,
        "meta/episodes/file_index": 0,
    }


def _write_json(path: Path, content: dict[str, Any]) -> None:
    path.write_text(json.dumps(content, indent=4, ensure_ascii=False), encoding="utf-8")
