"""Whole files or none: every write goes to a temporary name beside its target and is renamed."""

import os
from pathlib import Path


def write_whole(path: Path, content: bytes | str) -> None:
    """Write `content` to `path` so that a kill at any moment leaves the old file or the new one.

    Raises:
        OSError: It cannot be written; its `filename` is `path`.
    """
    data = content.encode() if isinstance(content, str) else content
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except OSError as error:
        # The name that the user knows, not that of the temporary file; none is told by a full disk.
        raise OSError(error.errno, error.strerror or str(error), str(path)) from error
    finally:
        temporary.unlink(missing_ok=True)
