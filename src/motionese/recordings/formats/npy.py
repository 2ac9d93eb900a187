"""Bare arrays of NumPy: `.npy` of [rows, channels] or [episodes, rows, channels], or a folder.

In a folder every file is an episode. Channels have no names there; rows at the end of an episode
that are NaN throughout are padding.
"""

from collections import Counter
from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

import numpy as np
from jaxtyping import Float, Shaped
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding, merged
from motionese.recordings.formats.conventions import UNREADABLE, WIDEST, natural, why
from motionese.recordings.formats.numbered_columns import numbered_columns
from motionese.recordings.formats.writing import check_even_and_whole, write_file
from motionese.recordings.recording import Episode, Recording

NUMBERS = "fiub"
"""Kinds of arrays that hold numbers."""


def read(path: Path, columns: Sequence[str] | None = None) -> Recording:
    """Read an array, or a folder of them; `columns` names the channels."""
    files = [path]
    if path.is_dir():
        files = sorted(path.glob("[!.]*.npy"), key=lambda file: natural(file.name))
    arrays = [(file, _array(file)) for file in files]
    widths = Counter(array.shape[-1] for _, array in arrays)
    width, count = widths.most_common(1)[0]
    for file, array in arrays:
        if array.shape[-1] != width:
            raise RecordingError(
                f"{file}: has {array.shape[-1]} channels, {count} of the {len(arrays)} files have "
                f"{width}; take it out of the folder"
            )
    names, findings = numbered_columns(path, width, columns)
    episodes: list[Episode] = []
    for file, array in arrays:
        whole = array.ndim == 2
        label = "" if len(arrays) == 1 else f"{file.stem}/"
        for i, values in enumerate([array] if whole else array):
            name = file.stem if whole else f"{label}{i}"
            kept, cut = without_padding(path, name, np.asarray(values, dtype=np.float64))
            episodes.append(Episode.whole(name, kept))
            findings += cut
    units = ("",) * width
    found = merged(findings)
    return Recording(path, names, units, {}, None, tuple(episodes), names, findings=found)


def write(path: Path, recording: Recording) -> None:
    """Write [episodes, rows, channels] in float64, shorter episodes padded with NaN.

    Names, units and the rate are lost. Gaps and uneven times are refused.
    """
    check_even_and_whole(path, recording, "a .npy array")
    longest = max(len(e.values) for e in recording.episodes)
    shape = (len(recording.episodes), longest, len(recording.channels))
    padded = np.full(shape, np.nan)
    for place, episode in zip(padded, recording.episodes, strict=True):
        place[: len(episode.values)] = episode.values
    content = BytesIO()
    np.save(content, padded)
    write_file(path, content.getvalue())


def without_padding(
    path: Path, name: str, values: Float[ndarray, "T D"]
) -> tuple[Float[ndarray, "_ D"], list[Finding]]:
    """Return an episode without rows at its end that are NaN throughout, and what was cut."""
    filled = np.flatnonzero(~np.isnan(values).all(axis=1))
    rows = int(filled[-1]) + 1 if len(filled) else 0
    if rows == len(values):
        return values, []
    what = f"{len(values) - rows} rows at its end are NaN throughout and are cut as padding"
    return values[:rows], [Finding("left out", path, what, "", name, row=rows)]


def _array(file: Path) -> Shaped[ndarray, "..."]:
    """Return an array of two or three dimensions, without reading it yet."""
    try:
        array = np.load(file, mmap_mode="r", allow_pickle=False)
    except UNREADABLE as error:
        objects = "Python objects" in str(error) or "pickle" in str(error)
        what = "holds Python objects, which are not loaded; save an array of numbers"
        raise RecordingError(
            f"{file}: {what if objects else f'not an array of NumPy: {why(error)}'}"
        ) from error
    if not isinstance(array, ndarray):
        raise RecordingError(f"{file}: not an array of NumPy but an archive; name it .npz")
    array = array[:, None] if array.ndim == 1 else array
    if array.dtype.kind not in NUMBERS or array.ndim not in {2, 3} or 0 in array.shape:
        raise RecordingError(
            f"{file}: expected numbers, [rows, channels] or [episodes, rows, channels], "
            f"got {array.dtype} of shape {array.shape}"
        )
    if array.shape[-1] > WIDEST:
        raise RecordingError(f"{file}: {array.shape[-1]} channels are no motion's but pictures'")
    return array
