"""Damaged HDF5 files, on which the HDF5 library crashes or hangs instead of refusing them."""

import subprocess
import sys
from pathlib import Path

from motionese.errors import RecordingError

SECONDS = 30.0
"""A walk over thousands of demonstrations takes a few."""

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


def check_walkable(path: Path) -> None:
    """Let a child process walk over the file's groups and attributes before we do.

    Of files with a few random bytes changed about one in a hundred takes the process down or
    keeps it for ever, nearly always in an attribute of variable length. What the walk merely
    refuses is left to the reading, which says why; `RecordingError` if it did not come back.
    """
    try:
        command = [sys.executable, "-P", "-c", _WALK, str(path)]
        walk = subprocess.run(command, capture_output=True, timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired as error:
        raise RecordingError(f"{path}: damaged: HDF5 does not get through it") from error
    if walk.returncode < 0:
        raise RecordingError(f"{path}: damaged: HDF5 crashes on it (signal {-walk.returncode})")
