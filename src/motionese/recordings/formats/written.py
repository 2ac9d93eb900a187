"""Files and folders of recordings, written whole or not at all."""

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from motionese.errors import RecordingError
from motionese.files import write_whole


def write_file(path: Path, content: bytes | str) -> None:
    """Write `content` to `path`; `RecordingError` where that cannot be done."""
    try:
        write_whole(path, content)
    except OSError as error:
        raise _cannot(path, error) from error


@contextmanager
def new_folder(path: Path) -> Iterator[Path]:
    """Give a temporary folder beside `path` that gets its name once it is filled.

    Raises:
        RecordingError: `path` exists and is not an empty folder (nothing is ever overwritten), or
            cannot be written.
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


def _cannot(path: Path, error: OSError) -> RecordingError:
    return RecordingError(f"{path}: cannot be written: {error.strerror or error}")
