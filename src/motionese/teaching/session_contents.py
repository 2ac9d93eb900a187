"""What a session's folder holds: its robots' places and files, and what was put away.

The server's process reads this, too: nothing heavy is imported here.
"""

import json
import re
import shutil
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Literal

Growth = Literal["told", "beginning", "never"]
"""When a robot opens its slow level: as the person says, from the beginning on, or never."""
LONGEST_NAME = 24
"""Of a robot [characters]."""
SESSION = "session.json"
PLACES = ("", "robot-2", "robot-3")
"""Folders of the robots of a session, in its own; the first lies in that itself."""
OPENED = ".opened-"
"""Begins the name of a folder into which a packed session is unpacked, to be looked at first."""
_KINDS = re.compile(r"[a-z][a-z0-9-]*\.(json|npz|safetensors)")
_EARLIER = "earlier-"
_PART, _REPLACING = ".earlier.part", ".replacing"


def belongs(name: str) -> bool:
    """Whether a path in a session's folder, such as "robot-2/session.json", is the session's."""
    place, _, file = name.rpartition("/")
    return place in PLACES and _KINDS.fullmatch(file) is not None


def contents(folder: Path, places: Iterable[str] = PLACES) -> list[str]:
    """Return the paths, in a session's folder, of the files in some of its places."""
    files = (file for place in places for file in sorted((folder / place).glob("*.*")))
    names = [file.relative_to(folder).as_posix() for file in files if file.is_file()]
    return [name for name in names if belongs(name)]


def robots_in(folder: Path) -> list[str]:
    """Return the places of a session's folder in which there is a robot."""
    return [place for place in PLACES if (folder / place / SESSION).is_file()]


def origins(folder: Path) -> set[str]:
    """Return what the robots of a session began from, those that were put away included."""
    found = set()
    for file in folder.rglob(SESSION):
        with suppress(OSError, ValueError, KeyError, TypeError, RecursionError):
            found.add(str(json.loads(file.read_text())["began"]))
    return found


def put_away(home: Path, what: Path, places: Iterable[str] = PLACES) -> Path:
    """Copy a session, or one of its robots, into a further subfolder of the session's folder.

    It can be opened there as a session of its own.

    Args:
        home: The session's folder.
        what: The same, or another in it.
        places: Whose robots are meant.

    Returns:
        The subfolder, which is there whole or not at all.
    """
    shutil.rmtree(home / _PART, ignore_errors=True)
    _copy(what, home / _PART, places)
    numbers = [int(p.name.removeprefix(_EARLIER)) for p in home.glob(f"{_EARLIER}[0-9]*")]
    earlier = home / f"{_EARLIER}{max(numbers, default=0) + 1:02d}"
    return (home / _PART).rename(earlier)


def replace_contents(folder: Path, by: Path) -> None:
    """Replace all files of a session by those of another that lies whole in a subfolder.

    A kill before this began leaves the old session; after that `settle` ends what was begun.
    """
    by.rename(folder / _REPLACING)
    settle(folder)


def settle(folder: Path) -> None:
    """End a replacement that was under way when its process was killed; clear what it left."""
    replacing = folder / _REPLACING
    if replacing.is_dir():
        for name in contents(folder):
            (folder / name).unlink()
        _copy(replacing, folder)
        replacing.rename(folder / f"{OPENED}done")
    shutil.rmtree(folder / _PART, ignore_errors=True)
    clear_opened(folder)


def clear_opened(folder: Path) -> None:
    """Remove what was unpacked in a session's folder and is not opened."""
    for left in folder.glob(f"{OPENED}*"):
        shutil.rmtree(left, ignore_errors=True)


def _copy(source: Path, target: Path, places: Iterable[str] = PLACES) -> None:
    for name in contents(source, places):
        file = target / name
        file.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source / name, file)
