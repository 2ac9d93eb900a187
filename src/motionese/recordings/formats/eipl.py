"""Folders of EIPL: `joints.npy` [N, T, J], in `train/` and `test/` or alone, all of one length.

EIPL pads shorter episodes by repeating their last row; others pad with zeros or NaN. Rows at the
end of an episode that are all zero or all NaN are cut, and of rows that are exactly the same up
to the end one is kept. The trap: a robot that truly stands at its last row, to the last bit, or
rests at zero in all joints, is cut as well.
"""

from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.formats.conventions import UNREADABLE, why
from motionese.recordings.formats.writing import check_even_and_whole, new_folder
from motionese.recordings.recording import Episode, Recording

JOINTS, BOUNDS = "joints.npy", "joint_bounds.npy"


def read(path: Path) -> Recording:
    """Read the joints, and what else of the same rows lies beside them; images are left alone."""
    parts = [p for p in (path, path / "train", path / "test") if (p / JOINTS).is_file()]
    if not parts:
        raise RecordingError(f"{path}: holds no {JOINTS}, nor do its folders train and test")
    contents = [(part, *_part(part)) for part in parts]
    channels, episodes = contents[0][1], []
    for part, names, rows in contents:
        if names != channels:
            raise RecordingError(
                f"{part}: its channels are {', '.join(names)}; "
                f"in {parts[0].name} they are {', '.join(channels)}"
            )
        prefix = "" if part == path else f"{part.name}/"
        for i, values in enumerate(rows):
            episodes.append(Episode.whole(f"{prefix}{i}", np.array(values[: _length(values)])))
    ranges = _ranges(path, [c for c in channels if c.startswith("joint_")])
    return Recording(path, channels, ("",) * len(channels), ranges, None, tuple(episodes), channels)


def write(path: Path, recording: Recording) -> None:
    """Write `joints.npy` (float32, padded with each last row) and `joint_bounds.npy`.

    The names and units of the channels and the rate are lost: EIPL has no place for them. Gaps and
    uneven times are refused.
    """
    check_even_and_whole(path, recording, "an EIPL folder")
    values = [e.values for e in recording.episodes]
    longest = max(map(len, values))
    padded = [np.pad(e, ((0, longest - len(e)), (0, 0)), mode="edge") for e in values]
    joints = np.stack(padded).astype(np.float32)
    extremes = zip(joints.min(axis=(0, 1)), joints.max(axis=(0, 1)), strict=True)
    ranges = [recording.ranges.get(c, e) for c, e in zip(recording.channels, extremes, strict=True)]
    bounds = np.array(ranges, dtype=np.float32).T
    with new_folder(path) as folder:
        np.save(folder / JOINTS, joints)
        np.save(folder / BOUNDS, bounds)


def _part(folder: Path) -> tuple[tuple[str, ...], Float[ndarray, "N T D"]]:
    """Return the channels of a folder and their padded rows."""
    joints = _array(folder / JOINTS)
    if joints.ndim != 3 or 0 in joints.shape:
        raise RecordingError(
            f"{folder / JOINTS}: expected [episodes, rows, joints], got shape {joints.shape}"
        )
    arrays = {"joint": joints}
    for file in sorted(folder.glob("*.npy")):
        array = _array(file) if file.name not in (JOINTS, BOUNDS) else joints
        if array is not joints and array.ndim == 3 and array.shape[:2] == joints.shape[:2]:
            arrays[file.stem] = array
    names = tuple(f"{stem}_{i}" for stem, array in arrays.items() for i in range(array.shape[2]))
    for stem, array in arrays.items():
        if array.dtype.kind not in "fiu":
            raise RecordingError(f"{folder}: the array of '{stem}' holds {array.dtype}, no numbers")
    return names, np.concatenate(list(arrays.values()), axis=2, dtype=np.float64)


def _length(values: Float[ndarray, "T D"]) -> int:
    """Return how many rows of a padded episode were recorded."""
    bits = np.ascontiguousarray(values).view(np.int64)
    changed = np.flatnonzero((bits != bits[-1]).any(axis=1))
    same = len(values) - (int(changed[-1]) + 1 if len(changed) else 0)
    empty = np.isnan(values[-1]).all() or (same > 1 and not values[-1].any())
    return len(values) - same + (0 if empty else 1)


def _ranges(path: Path, joints: list[str]) -> dict[str, tuple[float, float]]:
    """Return the joints' ranges of `joint_bounds.npy` [2, J], but for joints that never move."""
    if not (path / BOUNDS).is_file():
        return {}
    bounds = _array(path / BOUNDS)
    if bounds.shape != (2, len(joints)) or bounds.dtype.kind not in "fiu":
        raise RecordingError(
            f"{path / BOUNDS}: expected shape (2, {len(joints)}), lowest and highest of every "
            f"joint, got {bounds.dtype} of shape {bounds.shape}"
        )
    pairs = zip(joints, bounds[0].tolist(), bounds[1].tolist(), strict=True)
    return {name: (low, high) for name, low, high in pairs if -np.inf < low < high < np.inf}


def _array(file: Path) -> ndarray:
    """Return an array without reading it, so that images beside the joints cost nothing."""
    try:
        array = np.load(file, mmap_mode="r", allow_pickle=False)
    except UNREADABLE as error:
        raise RecordingError(f"{file}: not an array of NumPy: {why(error)}") from error
    if not isinstance(array, ndarray):
        raise RecordingError(f"{file}: not an array of NumPy but an archive")
    return array
