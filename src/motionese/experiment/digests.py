"""Digests of a folder's files: what has changed since it was written does not go unseen.

They stand in `SHA256SUMS`, as `sha256sum --check` reads them: a line a file, and behind them a
comment with the digest of these lines. The list is written after the files. A file that is not in
it does not count yet: a process was killed before all that belongs to it was written.
"""

import hashlib
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path

from motionese.errors import StorageError
from motionese.files import write_whole

DIGESTS = "SHA256SUMS"
OWN = "# "


def listed(folder: Path) -> dict[str, str]:
    """Return the SHA-256 of the files of a folder by their names; of none if there is no list.

    Raises:
        StorageError: The list has changed since it was written, or cannot be read.
    """
    path = folder / DIGESTS
    if not path.is_file():
        return {}
    try:
        lines, _, own = path.read_bytes().rpartition(OWN.encode())
    except OSError as error:
        raise StorageError(f"{path} cannot be read: {error.strerror}") from error
    if own != f"{_digest(lines)}\n".encode():
        raise StorageError(f"{path} has changed since it was written")
    pairs = (line.split("  ", 1) for line in lines.decode().splitlines())
    return {name: digest for digest, name in pairs}


def listed_and_there(folder: Path, pattern: str) -> list[Path]:
    """Return the files of a folder that count and match a pattern, by their names."""
    names = listed(folder)
    return sorted(path for path in folder.glob(pattern) if path.name in names)


def list_files(folder: Path, names: Iterable[str]) -> None:
    """Add files of a folder to its list, or list them anew."""
    _write(folder, listed(folder) | {n: _digest((folder / n).read_bytes()) for n in names})


def list_only(folder: Path, names: Collection[str]) -> None:
    """Take all other files off the list of a folder: they are about to be written anew."""
    _write(folder, {name: digest for name, digest in listed(folder).items() if name in names})


def changed(folder: Path) -> list[Path]:
    """Return the listed files that are missing, or have changed since they were written.

    Raises:
        StorageError: The list itself has, or a file cannot be read.
    """
    try:
        return [
            folder / name
            for name, digest in listed(folder).items()
            if not (folder / name).is_file() or _digest((folder / name).read_bytes()) != digest
        ]
    except OSError as error:
        raise StorageError(f"{error.filename} cannot be read: {error.strerror}") from error


def told(path: Path) -> str:
    """Return what to say of a listed file that is not as it was written."""
    return f"{path} {'has changed since it was written' if path.exists() else 'is missing'}"


def _write(folder: Path, digests: Mapping[str, str]) -> None:
    lines = "".join(f"{digest}  {name}\n" for name, digest in sorted(digests.items()))
    write_whole(folder / DIGESTS, f"{lines}{OWN}{_digest(lines.encode())}\n")


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
