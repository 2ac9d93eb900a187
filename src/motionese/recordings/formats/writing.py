"""Files and folders of recordings, written whole or not at all, and what fits into them."""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.files import write_whole
from motionese.recordings.formats.conventions import times_unless_even
from motionese.recordings.recording import Recording


def write_file(path: Path, content: bytes | str) -> None:
    """Write `content` to `path`; `RecordingError` where that cannot be done."""
    try:
        write_whole(path, content)
    except OSError as error:
        raise _cannot(path, error) from error


@contextmanager
def new_folder(path: Path) -> Iterator[Path]:
    """Give a temporary folder beside `path` that gets its name once it is filled.

    `RecordingError` where `path` exists and is not an empty folder (nothing is ever overwritten).
    """
    if path.exists() and not (path.is_dir() and not any(path.iterdir())):
        raise RecordingError(f"{path}: exists already; give the name of a new folder")
    try:
        with tempfile.TemporaryDirectory(dir=path.parent, prefix=f".{path.name}.") as temporary:
            # A folder inside, because the temporary one is readable by its owner alone.
            whole = Path(temporary) / path.name
            whole.mkdir()
            yield whole
            whole.replace(path)
    except OSError as error:
        raise _cannot(path, error) from error


def check_even_and_whole(path: Path, recording: Recording, what: str) -> None:
    """Refuse what a format of evenly spaced rows without masks cannot hold; `what` is its name.

    Raises:
        RecordingError: An episode is empty, has gaps, or is not evenly spaced at the rate.
    """
    if gap := recording.first(lambda e: ~(e.observed & np.isfinite(e.values))):
        raise RecordingError(
            f"{path}: {gap[0]}: nothing observed, and {what} cannot hold gaps; "
            "csv, npz and mcap can"
        )
    for episode in recording.episodes:
        where = f"{path}: episode '{episode.name}'"
        if not len(episode.values):
            raise RecordingError(f"{where} has no rows; {what} needs at least one")
        times, rate = episode.times, recording.rate_hz
        if times is not None and times_unless_even(times, rate) is not None:
            at = "at a known rate" if rate is None else f"at {rate:g} Hz"
            raise RecordingError(
                f"{where} is not evenly spaced {at}, and {what} holds no uneven times: "
                f"resample it first"
            )


def next_rows(states: Float[ndarray, "T D"]) -> Float[ndarray, "T D"]:
    """Return the action in every row of states: the next row; the last its own, where it ends."""
    return np.concatenate([states[1:], states[-1:]])


def _cannot(path: Path, error: OSError) -> RecordingError:
    return RecordingError(f"{path}: cannot be written: {error.strerror or error}")
