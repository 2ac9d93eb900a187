"""ALOHA's and ACT's HDF5: an episode a file, `observations/qpos`, `qvel`, `effort`, and `action`.

Channels of observations are named without `observations/`; the positions `qpos` are usual.
"""

from pathlib import Path
from typing import Any

from motionese.recordings.formats.hdf5_columns import (
    ACTIONS,
    is_group,
    paths,
    rate_in,
    recording_of,
    under,
    width,
)
from motionese.recordings.recording import Recording

WHAT = "observations/qpos and action"
OBSERVED, POSITIONS, PICTURES = "observations", "observations/qpos", "observations/images"


def holds(file: Any) -> bool:
    """Tell whether a file is of this layout."""
    return is_group(file.get(OBSERVED))


def recording(path: Path, file: Any) -> Recording:
    """Return the file's only episode, which is called as the file is."""
    tables = [key for key in paths(file) if width(file[key]) and not under(key, PICTURES)]
    own = [key for key in tables if under(key, OBSERVED, *ACTIONS)]
    # Others tell of the pictures, such as `compress_len`, unless they have as many rows.
    rows = {len(file[key]) for key in own}
    tables = [key for key in tables if key in own or len(file[key]) in rows]
    usual = POSITIONS if POSITIONS in tables else OBSERVED
    return recording_of(
        path, [(path.stem, file)], tables, OBSERVED, rate_in(file.attrs), usual=usual
    )
