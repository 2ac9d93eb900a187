"""Which format a file or folder of recordings is in, and reading and writing it."""

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from unicodedata import category

from motionese.errors import RecordingError, SettingError, unknown
from motionese.recordings.formats import csv, eipl, lerobot, mcap, npz, robomimic
from motionese.recordings.recording import Recording


@dataclass(frozen=True)
class Format:
    """One format: how it is recognised, read and written.

    Attributes:
        what: What is read, in words.
        suffixes: Of a file in this format.
        inside: Patterns of a file that a folder in this format holds.
    """

    what: str
    suffixes: tuple[str, ...]
    inside: tuple[str, ...]
    read: Callable[..., Recording]
    write: Callable[[Path, Recording], None]


FORMATS = {
    "npz": Format("motionese's own .npz", (".npz",), (), npz.read, npz.write),
    "lerobot": Format(
        "a LeRobotDataset folder", (), ("meta/info.json",), lerobot.read, lerobot.write
    ),
    "eipl": Format(
        "an EIPL folder (joints.npy)",
        (),
        ("joints.npy", "train/joints.npy", "test/joints.npy"),
        eipl.read,
        eipl.write,
    ),
    "robomimic": Format("robomimic .hdf5", (".hdf5", ".h5"), (), robomimic.read, robomimic.write),
    "mcap": Format(
        ".mcap with JSON messages or a folder of them",
        (".mcap",),
        ("*.mcap",),
        mcap.read,
        mcap.write,
    ),
    "csv": Format(
        ".csv or a folder of them",
        (*csv.SUFFIXES, ".txt"),
        ("*.[cC][sS][vV]", "*.[tT][sS][vV]"),
        csv.read,
        csv.write,
    ),
}
"""By name, in the order in which a folder is tried."""


CONTROL = ("Cc", "Cs")
"""Kinds of characters that are no text: control characters, and halves of what is no UTF-8."""


def read(
    path: str | Path,
    format: str | None = None,
    *,
    episode: str | None = None,
    time: str | None = None,
) -> Recording:
    """Read a file or folder of recordings.

    Args:
        path: The file or folder.
        format: One of `FORMATS`; found from the name or what the folder holds where left out.
        episode: The column that names the episode, where the file is a table (csv).
        time: The column that holds the time, where the file is a table (csv).

    Raises:
        RecordingError: Nothing there, or not what it is said to be.
        SettingError: A format that does not exist, or columns named for what is no table.
    """
    path = Path(path)
    try:
        there = path.exists()
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    if not there:
        raise RecordingError(f"{path}: there is no such file or folder")
    name = _known(format) if format is not None else _found(path)
    columns = {"episode": episode, "time": time}
    given = {key: value for key, value in columns.items() if value is not None}
    if given and name != "csv":
        raise SettingError(f"{path}: {next(iter(given))} names a column of csv; this is {name}")
    recording = FORMATS[name].read(path, **given)
    _check(recording)
    return recording


def write(path: str | Path, recording: Recording, format: str | None = None) -> None:
    """Write a recording, whole or not at all.

    Args:
        path: The file or folder to write.
        recording: What to write.
        format: One of `FORMATS`; from the suffix of `path` where left out.

    Raises:
        RecordingError: The format cannot hold the recording, or `path` cannot be written.
        SettingError: A format that does not exist, or none given and a suffix that tells none.
    """
    path = Path(path)
    name = _known(format) if format is not None else _by_suffix(path)
    if name is None:
        raise SettingError(
            f"{path}: its name does not tell the format; end it in "
            f"{', '.join(s for f in FORMATS.values() for s in f.suffixes)}, "
            f"or name the format (--to), one of {', '.join(FORMATS)}"
        )
    _check(recording)
    FORMATS[name].write(path, recording)


def _known(format: str) -> str:
    if format not in FORMATS:
        raise SettingError(unknown("format", format, FORMATS))
    return format


def _found(path: Path) -> str:
    name = _in_folder(path) if path.is_dir() else _by_suffix(path)
    if name is None:
        raise RecordingError(
            f"{path}: not a recording that is read here: "
            f"{', '.join(f.what for f in FORMATS.values())}"
        )
    return name


def _by_suffix(path: Path) -> str | None:
    return next((n for n, f in FORMATS.items() if path.suffix.lower() in f.suffixes), None)


def _in_folder(path: Path) -> str | None:
    return next((n for n, f in FORMATS.items() if any(any(path.glob(p)) for p in f.inside)), None)


def _check(recording: Recording) -> None:
    """Check what holds for every format, so that no reader need check it."""
    for kind, names in (
        ("channel", recording.channels),
        ("episode", [e.name for e in recording.episodes]),
    ):
        if not names:
            raise RecordingError(f"{recording.source}: holds no {kind}")
        strange = [n for n in names if not n.strip() or any(category(c) in CONTROL for c in n)]
        if strange:
            raise RecordingError(
                f"{recording.source}: a {kind} is called {strange[0]!a}; "
                "names are text without line breaks"
            )
        doubled = [name for name, count in Counter(names).items() if count > 1]
        if doubled:
            raise RecordingError(
                f"{recording.source}: {kind} names must be unique; doubled: {', '.join(doubled)}"
            )
