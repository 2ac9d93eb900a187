"""Folders of EIPL: `joints.npy` [N, T, J], in `train/` and `test/` or alone, all of one length.

EIPL pads shorter episodes by repeating their last row; others pad with zeros or NaN. What is
padding is cut, and told: see `eipl_padding`. The episodes in `test/` are held out.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.conventions import UNREADABLE, why
from motionese.recordings.formats.eipl_padding import recorded_lengths
from motionese.recordings.formats.writing import check_even_and_whole, new_folder
from motionese.recordings.recording import Episode, Recording

JOINTS, BOUNDS = "joints.npy", "joint_bounds.npy"


def read(path: Path) -> Recording:
    """Read the joints, and what else of the same rows lies beside them; images are left alone."""
    parts = [p for p in (path, path / "train", path / "test") if (p / JOINTS).is_file()]
    if not parts:
        raise RecordingError(f"{path}: holds no {JOINTS}, nor do its folders train and test")
    contents = [(part, *_part(part)) for part in parts]
    channels = contents[0][1]
    padded: dict[str, Float[ndarray, "_ D"]] = {}
    for part, names, rows in contents:
        if names != channels:
            raise RecordingError(
                f"{part}: its channels are {', '.join(names)}; "
                f"in {parts[0].name} they are {', '.join(channels)}"
            )
        prefix = "" if part == path else f"{part.name}/"
        padded |= {f"{prefix}{i}": values for i, values in enumerate(rows)}
    lengths = recorded_lengths(list(padded.values()))
    cut = zip(padded.items(), lengths, strict=True)
    episodes = tuple(Episode.whole(name, np.array(rows[:length])) for (name, rows), length in cut)
    ranges = _ranges(path, [c for c in channels if c.startswith("joint_")])
    units = ("",) * len(channels)
    found = Recording(path, channels, units, ranges, None, episodes, channels)
    apart = tuple(name for name in padded if name.startswith("test/")) if len(parts) > 1 else ()
    return replace(found, held_out=apart).found(*_cut(path, padded, lengths))


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


def _cut(
    path: Path, padded: Mapping[str, Float[ndarray, "_ D"]], lengths: Sequence[int]
) -> Iterable[Finding]:
    """Yield, once, that rows were left out."""
    cut = {n: len(rows) - k for (n, rows), k in zip(padded.items(), lengths, strict=True)}
    cut = {name: rows for name, rows in cut.items() if rows}
    if cut:
        name = next(iter(cut))
        what = (
            f"{sum(cut.values())} rows at the ends of {len(cut)} of {len(padded)} episodes only "
            "pad them to the length of the longest: left out"
        )
        remedy = f"give {path / name.rpartition('/')[0] / JOINTS} itself to keep them"
        yield Finding("left out", path, what, remedy, name, row=len(padded[name]) - cut[name])


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
