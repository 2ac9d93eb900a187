"""Files that take the HDF5 library down are found out before we read them."""

import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from motionese.errors import RecordingError

SECONDS = 30.0
"""The longest walk over one file: one over thousands of demonstrations takes a few."""
_WALK = """
import faulthandler, sys, h5py
from contextlib import suppress
def visit(name, item):
    for key in item.attrs:
        with suppress(Exception):
            item.attrs[key]
for i, path in enumerate(sys.stdin.read().split("\\0")):
    print(i, flush=True)
    faulthandler.dump_traceback_later(float(sys.argv[1]), exit=True)
    with suppress(Exception), h5py.File(path, "r") as file:
        file.visititems(visit)
"""
_TOO_LONG = 1
"""Exit status of a process that faulthandler ended."""


def check_walkable(files: Sequence[Path]) -> None:
    """Let one child process walk over the groups and attributes of all files before we do.

    The HDF5 library crashes or hangs on damaged files: of those with a few random bytes changed
    about one in a hundred takes the process down or keeps it for ever, nearly always in an
    attribute of variable length. What the walk merely refuses is left to the reading.
    """
    walk = subprocess.run(
        [sys.executable, "-P", "-c", _WALK, str(SECONDS)],
        input="\0".join(map(str, files)).encode(errors="surrogateescape"),
        capture_output=True,
        check=False,
    )
    if walk.returncode == 0 or not (begun := walk.stdout.split()):
        return
    damaged = files[int(begun[-1])]
    if walk.returncode == _TOO_LONG:
        raise RecordingError(f"{damaged}: damaged: HDF5 does not get through it")
    raise RecordingError(f"{damaged}: damaged: HDF5 crashes on it (status {walk.returncode})")
