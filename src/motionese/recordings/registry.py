"""Which format a file or folder of recordings is in, and reading and writing it."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any
from unicodedata import category

from motionese.errors import RecordingError, SettingError, unknown
from motionese.recordings.formats import csv, eipl, hdf5, lerobot, mcap, npy, npz, rosbag
from motionese.recordings.nature import judged
from motionese.recordings.recording import Recording
from motionese.recordings.stored import StoredRecording


@dataclass(frozen=True)
class Format:
    """One format: how it is recognised, and the module that reads and writes it.

    Attributes:
        what: What is read, in words.
        module: Its functions are `read(path, **options) -> Recording` and `write(path, recording)`.
            Both raise `RecordingError` where a file is not what it should be, or cannot hold the
            recording or be written, and `MissingPackageError` where the package of their extra is
            missing.
        suffixes: Of a file in this format.
        inside: Patterns of a file that a folder in this format holds.
        options: Which of `OPTIONS` its `read` takes.
        perhaps: Patterns of a file that a folder in this format holds if it is in no other.
        chosen: Whether its channels were chosen when it was written.
        written: Whether the module has a `write`.
        stored: Whether it has a `stored(path) -> StoredRecording`, whose episodes are read one at a
            time.
    """

    what: str
    module: ModuleType
    suffixes: tuple[str, ...] = ()
    inside: tuple[str, ...] = ()
    options: tuple[str, ...] = ()
    perhaps: tuple[str, ...] = ()
    chosen: bool = False
    written: bool = True
    stored: bool = False


OPTIONS = {
    "episode": "the column that names the episode",
    "time": "the column that holds the time",
    "columns": "the names of columns without a header",
    "topics": "the topics that are read",
    "pause": "the silence that cuts a log into takes",
    "marker": "the topic that marks the takes of a log",
}
"""What a user may say of a file, beside its format, of what not every format has."""
JOINTS = tuple(f"{folder}joints.npy" for folder in ("", "train/", "test/"))
BAGS = (
    (".bag", ".db3", ".zstd", ".active"),
    tuple(
        f"{i}*{end}" for i in ("", "*/") for end in (".bag", ".db3", ".mcap", ".zstd", ".active")
    ),
)
OF_TABLES, OF_LOGS = ("episode", "time", "columns"), ("topics", "pause", "marker")
HDF5 = Format(
    *(f"HDF5 of {', '.join(hdf5.LAYOUTS)} or a folder of them", hdf5, hdf5.SUFFIXES, hdf5.INSIDE),
    stored=True,
)
FORMATS = {
    "npz": Format(
        "motionese's own .npz or another",
        npz,
        (".npz",),
        options=("columns",),
        chosen=True,
        stored=True,
    ),
    "lerobot": Format("a LeRobotDataset folder", lerobot, inside=("meta/info.json",), stored=True),
    "eipl": Format("an EIPL folder (joints.npy)", eipl, inside=JOINTS),
    "hdf5": HDF5,
    "robomimic": HDF5,
    "mcap": Format(".mcap or a folder of them", mcap, (".mcap",), ("*.mcap",), OF_LOGS),
    "csv": Format(
        *(".csv or a folder of them", csv, csv.SUFFIXES, csv.patterns(csv.SURE), OF_TABLES),
        perhaps=csv.patterns(csv.SUFFIXES),
    ),
    "npy": Format(".npy or a folder of them", npy, (".npy",), ("*.npy",), ("columns",)),
    "rosbag": Format("a ROS bag or a folder of them", rosbag, *BAGS, OF_LOGS, written=False),
}
"""By name, in the order in which a folder is tried."""
CONTROL = ("Cc", "Cs")
"""Kinds of characters that are no text: control characters, and halves of what is no UTF-8."""


def read(path: str | Path, format: str | None = None, **options: Any) -> Recording:
    """Read a file or folder of recordings.

    Args:
        path: The file or folder.
        format: One of `FORMATS`; found from the name or what the folder holds where left out.
        options: Any of `OPTIONS` that the format takes; None counts as left out.

    Raises:
        RecordingError: Nothing there, or not what it is said to be.
        SettingError: A format or option that does not exist, or that the format does not take.
    """
    path, name = _there(path, format)
    given = {option: told for option, told in options.items() if told is not None}
    for option in given:
        if option not in OPTIONS:
            raise SettingError(unknown("option", option, OPTIONS))
        if option not in FORMATS[name].options:
            takes = ", ".join(n for n, f in FORMATS.items() if option in f.options)
            raise SettingError(
                f"{path}: {option} is {OPTIONS[option]}, of {takes} alone; this is {name}"
            )
    recording = _checked(FORMATS[name].module.read(path, **given))
    return recording if FORMATS[name].chosen else judged(recording)


def read_stored(path: str | Path, format: str | None = None) -> StoredRecording:
    """Open a recording whose episodes are read one at a time; arguments as of `read`.

    Raises:
        RecordingError: Nothing there, not what it is said to be, or of a format that is read whole.
        SettingError: A format that does not exist.
    """
    path, name = _there(path, format)
    if not FORMATS[name].stored:
        known = ", ".join(n for n, f in FORMATS.items() if f.stored)
        raise RecordingError(
            f"{path}: only {known} can be left where they are (--stored); this is {name}"
        )
    found: StoredRecording = FORMATS[name].module.stored(path)
    _checked(found.outline)
    return found


def write(path: str | Path, recording: Recording, format: str | None = None) -> None:
    """Write a recording, whole or not at all; the suffix of `path` tells a format not given.

    Raises:
        RecordingError: The format cannot hold the recording, or `path` cannot be written.
        SettingError: A format that does not exist, or none given and a suffix that tells none.
    """
    path = Path(path)
    name = _named(format) or _by_suffix(path)
    written = [n for n, f in FORMATS.items() if f.written]
    if name is None:
        suffixes = dict.fromkeys(s for n in written for s in FORMATS[n].suffixes)
        raise SettingError(
            f"{path}: its name does not tell the format; end it in {', '.join(suffixes)}, "
            f"or name the format (--to), one of {', '.join(written)}"
        )
    if name not in written:
        raise RecordingError(
            f"{path}: {FORMATS[name].what} is read, not written; "
            f"--to is one of {', '.join(written)}"
        )
    FORMATS[name].module.write(path, _checked(recording))


def _there(path: str | Path, format: str | None) -> tuple[Path, str]:
    """Return a path at which something is, and the name of its format."""
    path = Path(path)
    try:
        there = path.exists()
    except OSError as error:
        raise RecordingError(f"{path}: cannot be read: {error.strerror}") from error
    if not there:
        raise RecordingError(f"{path}: there is no such file or folder")
    return path, _named(format) or _found(path)


def _named(format: str | None) -> str | None:
    if format is not None and format not in FORMATS:
        raise SettingError(unknown("format", format, FORMATS))
    return format


def _found(path: Path) -> str:
    rules = [
        *((n, f.inside) for n, f in FORMATS.items()),
        *((n, f.perhaps) for n, f in FORMATS.items()),
    ]
    holding = (n for n, patterns in rules if any(any(path.glob(p)) for p in patterns))
    name = next(holding, None) if path.is_dir() else _by_suffix(path)
    if name is None:
        known = ", ".join(dict.fromkeys(f.what for f in FORMATS.values()))
        raise RecordingError(f"{path}: not a recording that is read here: {known}")
    return name


def _by_suffix(path: Path) -> str | None:
    return next((n for n, f in FORMATS.items() if path.suffix.lower() in f.suffixes), None)


def _checked(recording: Recording) -> Recording:
    """Check what holds for every format, so that no reader need check it."""
    episodes = tuple(e.name for e in recording.episodes)
    for kind, names in (("channel", recording.channels), ("episode", episodes)):
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
    return recording
