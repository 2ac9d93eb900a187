"""What commands write, looked at before they work for minutes."""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path

from motionese.errors import SettingError, StorageError
from motionese.recordings import FORMATS

RECORDINGS = tuple(suffix for known in FORMATS.values() for suffix in known.suffixes)
"""Suffixes of recordings that are one file."""
PICTURES = (".svg", ".png")
MODEL_SUFFIX = ".safetensors"


def check_output(option: str, path: Path, suffixes: Sequence[str]) -> None:
    """Refuse the name of a file, given with an option, that could not be written.

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


def check_apart(sources: Iterable[Path], *outputs: Path | None) -> None:
    """Refuse an output that is a source, or lies in a folder that is read and would count there.

    A source may be there under another spelling, or through a link.

    Raises:
        SettingError: Writing it would destroy or change what is read.
    """
    for out in filter(None, outputs):
        for source in sources:
            if out.exists() and source.exists() and out.samefile(source):
                raise SettingError(f"{out}: this is what is read ({source}); give another name")
            inside = source.is_dir() and source.resolve() in out.resolve().parents
            if inside and out.suffix.lower() in {"", *RECORDINGS}:
                raise SettingError(
                    f"{out}: lies in the folder that is read ({source}), and would count as one of "
                    "its recordings; give another place"
                )
