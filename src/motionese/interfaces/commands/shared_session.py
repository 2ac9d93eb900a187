"""A session that comes as one file: `motionese teach --session FILE`."""

import shutil
from pathlib import Path

from motionese.errors import SettingError, StorageError
from motionese.teaching.packed_session import SUFFIX, unpack
from motionese.teaching.session_contents import OPENED


def session_folder(session: Path, into: Path | None) -> Path:
    """Return the folder of a session; one that comes as a file is unpacked, and read to be sure.

    Args:
        session: The folder, or the file.
        into: Where a file is unpacked; beside it where left out.

    Raises:
        StorageError: There is no such file, it is no session, or the folder is there already.
        SettingError: `into` is told, but no file.
    """
    if session.is_dir() or not (session.is_file() or session.suffix == SUFFIX):
        if into is not None:
            raise SettingError(f"--into {into}: only a --session that is a file is unpacked")
        return session
    if not session.is_file():
        raise StorageError(f"{session}: no such file")
    folder = into or _beside(session)
    if folder.exists():
        raise StorageError(
            f"{folder} is there already: go on with --session {folder}, or unpack {session} "
            "--into another folder"
        )
    _unpack_whole(session, folder)
    return folder


def _unpack_whole(file: Path, folder: Path) -> None:
    """Unpack a session; the folder is there when all of it can be read, or not at all."""
    # Reading needs what takes time to import.
    from motionese.teaching.school import check_opened  # noqa: PLC0415

    part = folder.with_name(f"{OPENED}{folder.name}")
    try:
        unpack(file, part)
        check_opened(part, str(file))
        part.rename(folder)
    except OSError as error:
        raise StorageError(f"{folder} cannot be written: {error.strerror}") from error
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _beside(file: Path) -> Path:
    return file.with_suffix("") if file.suffix else file.with_name(f"{file.name}-session")
