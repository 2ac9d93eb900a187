"""Whole files or none: every write goes to a temporary name beside its target and is renamed."""

import os
from pathlib import Path


def write_whole(path: Path, content: bytes | str) -> None:
    """Write `content` to `path` so that a kill at any moment leaves the old file or the new one."""
    data = content.encode() if isinstance(content, str) else content
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with temporary.open("wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
