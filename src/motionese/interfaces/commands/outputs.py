"""What a command is to write, looked at before it works for minutes."""

import os
from collections.abc import Sequence
from pathlib import Path

from motionese.errors import SettingError, StorageError
from motionese.recordings import FORMATS

RECORDINGS = tuple(suffix for known in FORMATS.values() for suffix in known.suffixes)
"""Suffixes of recordings that are one file."""
PICTURES = (".svg", ".png")
MODEL_SUFFIX = ".safetensors"


def check_output(option: str, path: Path, suffixes: Sequence[str]) -> None:
    """Refuse the name of a file that could not be written.

    Args:
        option: What the user has named it with, for the message.
        path: The file.
        suffixes: What its name may end in.

    Raises:
        SettingError: Another suffix.
        StorageError: A folder is called so, or the file's folder is missing or read-only.
    """
    if path.suffix.lower() not in suffixes:
        raise SettingError(f"{option} {path}: its name must end in {', '.join(suffixes)}")
    if path.is_dir():
        raise StorageError(f"{option} {path}: this is a folder; give the name of a file")
    folder = path.absolute().parent
    if not folder.is_dir():
        raise StorageError(f"{option} {path}: there is no folder {path.parent}")
    if not os.access(folder, os.W_OK):
        raise StorageError(f"{option} {path}: the folder {path.parent} cannot be written to")
