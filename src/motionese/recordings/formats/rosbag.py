"""Logs of topics: bags of ROS 1 and 2, read without ROS, and MCAP.

A bag is a .bag, .db3 or .mcap file, or a folder as `ros2 bag record` leaves it. One is one episode,
unless its silences or a topic cut it into takes; a folder of them is a recording. Channels are
named TOPIC.a.b by where the number stands in the message.
"""

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path, PurePosixPath

from pydantic import BaseModel, ConfigDict, ValidationError

from motionese.errors import RecordingError
from motionese.faults import described
from motionese.recordings.finding import Finding
from motionese.recordings.formats.bag_files import COMPRESSED, READING, messages
from motionese.recordings.formats.conventions import imported, natural, why
from motionese.recordings.formats.log_recording import recording_of
from motionese.recordings.formats.message_log import Find, Log, Track
from motionese.recordings.formats.takes import Cuts
from motionese.recordings.formats.topic_choice import TopicChoice
from motionese.recordings.recording import Recording

SUFFIXES = (".bag", ".db3", f".db3{COMPRESSED}", ".mcap", f".mcap{COMPRESSED}")
"""Of the files that hold messages."""
METADATA = "metadata.yaml"
OPEN = ".active"
"""What a recorder of ROS 1 adds to the name of a bag until it closes it."""


class _Bag(BaseModel):
    """What metadata.yaml tells of a bag that is needed here."""

    model_config = ConfigDict(frozen=True, extra="ignore")

    relative_file_paths: tuple[str, ...]
    ros_distro: str | None = None


def read(
    path: Path,
    topics: Sequence[str] | None = None,
    pause: float | None = None,
    marker: str | None = None,
) -> Recording:
    """Read a bag, or a folder of bags in natural order.

    Rows and rate are as `recording_of` tells. All channels are usual but headers, stamps and
    sequence numbers; in ROS also covariances, and velocities, accelerations, efforts of joints.

    Args:
        path: The file or folder.
        topics: Patterns of the topics to read, or one; all that tell a motion where left out.
        pause: A silence longer than this [s] cuts an episode in two.
        marker: The topic that marks takes, as `Mark` tells.
    """
    cuts, choice = Cuts(pause, marker), TopicChoice(topics, marker)
    bags, still_open = _bags(path)
    logs = [_log(bag, choice) for bag in bags]
    choice.check(path, logs)
    what, remedy = "it is left out, as its recorder did not close it", "`rosbag reindex`"
    found = [Finding("left out", bag, what, f"{remedy} makes it whole") for bag in still_open]
    return recording_of(path, logs, cuts).found(*found)


def _bags(path: Path) -> tuple[list[Path], list[Path]]:
    """Return the files and folders that are a bag each, and those that were not closed."""
    if path.name.endswith(OPEN):
        raise RecordingError(
            f"{path}: its recorder did not close it; `rosbag reindex` makes it whole"
        )
    if not path.is_dir() or (path / METADATA).exists():
        return [path], []
    inside = sorted(path.glob("[!.]*"), key=lambda p: natural(p.name))
    bags = [p for p in inside if _is_stored(p) or (p.is_dir() and _stored_in(p))]
    if not bags:
        raise RecordingError(f"{path}: holds no {', '.join(SUFFIXES)}")
    return bags, [p for p in inside if p.name.endswith(OPEN)]


def _log(bag: Path, choice: TopicChoice) -> Log:
    if not bag.is_dir():
        name = Path(bag.name.removesuffix(COMPRESSED)).stem
        return choice.read(bag, name, partial(messages, bag))
    told = _told(bag)
    files = [bag / PurePosixPath(name).name for name in told.relative_file_paths]
    if missing := [file.name for file in files if not file.exists()]:
        raise RecordingError(f"{bag}: {missing[0]} is missing, of which {METADATA} tells")

    def whole(find: Find) -> Iterator[tuple[Track, int, bytes]]:
        for file in files:
            yield from messages(file, find)

    return choice.read(bag, bag.name, whole, told.ros_distro or "")


def _is_stored(path: Path) -> bool:
    return path.is_file() and path.name.lower().endswith(SUFFIXES)


def _stored_in(folder: Path) -> list[str]:
    return sorted((p.name for p in folder.glob("[!.]*") if _is_stored(p)), key=natural)


def _told(bag: Path) -> _Bag:
    """Return what a folder tells of itself; where it does not, it is of all files in it."""
    file = bag / METADATA
    if not file.exists():
        return _Bag(relative_file_paths=tuple(_stored_in(bag)))
    yaml = imported("ruamel.yaml", "ros", READING)
    try:
        content = yaml.YAML(typ="safe", pure=True).load(file.read_text(encoding="utf-8"))
        return _Bag.model_validate(content["rosbag2_bagfile_information"])
    # What the parser raises depends on what is damaged.
    except Exception as error:
        said = described(error) if isinstance(error, ValidationError) else why(error)
        raise RecordingError(
            f"{file}: not what `ros2 bag record` writes ({said}); `ros2 bag reindex` mends it"
        ) from error
