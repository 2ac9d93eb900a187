"""A session in one file, to be shared: what its folder holds, zipped.

What comes from elsewhere is checked before a byte of it is written: names that a session has, no
name twice, no more than a session can be. The server's process reads this, too: nothing heavy is
imported here.
"""

import io
import json
import shutil
import zlib
from collections import Counter
from pathlib import Path
from zipfile import ZIP_DEFLATED, BadZipFile, ZipFile

from motionese.errors import StorageError
from motionese.files import write_whole
from motionese.teaching.session_contents import PLACES, SESSION, belongs, contents

SUFFIX = ".motionese"
MANIFEST, FORMAT, VERSION = "school.json", "motionese-school", 1
"""The file that says what a folder, or a packed session, is; a folder of one robot may lack it."""
MOST_PACKED, MOST_UNPACKED, MOST_FILES = 64 * 2**20, 512 * 2**20, 20_000
"""Bytes of a packed session and of its files together, and how many they may be."""
MOST_TOLD = 4096
"""Bytes of a manifest."""
ATTEMPTS = 20
DAMAGED = (BadZipFile, zlib.error, ValueError, EOFError, NotImplementedError, RuntimeError)
"""What a file meets that is no whole archive, or is one that no session was packed in."""


def pack(folder: Path) -> bytes:
    """Return a session packed into one file.

    It may be written to meanwhile: it is packed as it was at one moment.

    Raises:
        StorageError: There is no session, it cannot be read, or it is too large to be opened again.
    """
    for _ in range(ATTEMPTS):
        try:
            files = _snapshot(folder)
        except FileNotFoundError:
            continue
        except OSError as error:
            raise StorageError(f"{folder} cannot be read: {error.strerror}") from error
        if files:
            break
    else:
        raise StorageError(f"{folder}: there is no session to be packed")
    files.setdefault(MANIFEST, manifest(""))
    packed = io.BytesIO()
    with ZipFile(packed, "w", ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name, content)
    if packed.tell() > MOST_PACKED:
        raise StorageError(f"{folder}: larger than the {_mib(MOST_PACKED)} that can be opened")
    return packed.getvalue()


def manifest(taught: str) -> bytes:
    """Return what says which robot, by its place, is being taught."""
    return json.dumps({"format": FORMAT, "version": VERSION, "taught": taught}).encode()


def taught_of(content: bytes, where: object) -> str:
    """Return the place of the robot that is being taught, as a manifest says it.

    Raises:
        StorageError: It is none, or one of another format.
    """
    try:
        facts = json.loads(content)
        form, version, taught = facts["format"], facts["version"], str(facts["taught"])
    except (ValueError, KeyError, TypeError, RecursionError) as error:
        raise StorageError(f"{where} was not written by motionese") from error
    if form != FORMAT or (version == VERSION and taught not in PLACES):
        raise StorageError(f"{where} was not written by motionese")
    if version != VERSION:
        raise StorageError(
            f"{where}: session of several robots of format {version}, this version of motionese "
            f"reads {VERSION}; open it with the version that wrote it"
        )
    return taught


def unpack(file: Path, folder: Path, called: str = "") -> None:
    """Unpack a session into a folder, which is made.

    Args:
        file: The packed session.
        folder: Where it is to lie.
        called: What the file is called where it is refused, if not by its path.

    Raises:
        StorageError: It is no packed session, or it cannot be written; the folder may then be left.
    """
    called = called or str(file)
    try:
        if file.stat().st_size > MOST_PACKED:
            raise StorageError(f"{called}: larger than {_mib(MOST_PACKED)}, no session is")
        with ZipFile(file) as archive:
            _check(archive, called)
            for each in archive.infolist():
                target = folder / each.filename
                target.parent.mkdir(parents=True, exist_ok=True)
                with archive.open(each) as packed, target.open("wb") as unpacked:
                    shutil.copyfileobj(packed, unpacked)
    except DAMAGED as error:
        raise StorageError(f"{called} is no session, or was damaged ({error})") from error
    except OSError as error:
        raise StorageError(f"{error.filename or called}: {error.strerror or error}") from error


def write_taught(folder: Path, taught: str) -> None:
    """Keep which robot is being taught; `OSError` if it cannot be written."""
    write_whole(folder / MANIFEST, manifest(taught))


def read_taught(folder: Path) -> str:
    """Return the place of the robot that is being taught; `StorageError` as in `taught_of`."""
    file = folder / MANIFEST
    return taught_of(file.read_bytes(), file) if file.is_file() else ""


def _check(archive: ZipFile, called: str) -> None:
    """Refuse what is no session, before anything of it is unpacked."""
    files = archive.infolist()
    names = Counter(each.filename for each in files)
    if MANIFEST not in names or SESSION not in names:
        raise StorageError(f"{called} is no session that motionese has packed")
    if len(files) > MOST_FILES or sum(each.file_size for each in files) > MOST_UNPACKED:
        raise StorageError(f"{called}: it would unpack to more than a session can be; refused")
    # An archive's member is never read further than the size it tells, which was counted above.
    with archive.open(MANIFEST) as content:
        taught_of(content.read(MOST_TOLD), called)
    odd = [name for name, count in names.items() if count > 1 or not belongs(name)]
    if odd:
        raise StorageError(f"{called}: {odd[0]!r} is no file of a session; refused")


def _snapshot(folder: Path) -> dict[str, bytes]:
    """Return the files of a moment, none where they have changed meanwhile.

    The sessions' own files are read first: what they name stays until they are written again.
    """
    names = sorted(contents(folder), key=lambda name: not name.endswith(SESSION))
    files = {name: (folder / name).read_bytes() for name in names}
    own = {name: content for name, content in files.items() if name.endswith(SESSION)}
    same = all((folder / name).read_bytes() == content for name, content in own.items())
    return files if same and SESSION in files else {}


def _mib(size: int) -> str:
    return f"{size // 2**20} MiB"
