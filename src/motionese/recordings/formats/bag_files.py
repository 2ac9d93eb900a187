"""The messages of one file of a ROS bag, of ROS 1 or ROS 2, compressed or not."""

from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from motionese.errors import MotioneseError, RecordingError
from motionese.recordings.formats import mcap_records
from motionese.recordings.formats.conventions import imported, why
from motionese.recordings.formats.message_log import Find, Topic, Track

COMPRESSED = ".zstd"
READING = "reading ROS bags"
_BEGINNING = b"\x28\xb5\x2f\xfd"
"""Of compressed data; no message begins so."""
_JOURNALS = ("-wal", "-journal")
"""What SQLite adds to the name of a database for the file of what is not in it yet."""
_REINDEX = {".bag": "`rosbag reindex`", ".db3": "`ros2 bag reindex`"}


def messages(file: Path, find: Find) -> Iterator[tuple[Track, int, bytes]]:
    """Yield the messages that `find` wants, with the times [ns] at which they were recorded.

    Raises:
        RecordingError: A file that is none of a bag, was not closed, is cut short, or damaged.
        MissingPackageError: A package for it is missing.
    """
    if file.suffix.lower() == COMPRESSED:
        with TemporaryDirectory() as folder:
            whole = Path(folder) / file.stem
            _decompress(file, whole)
            yield from _unpacked(whole, file, find)
    else:
        yield from _unpacked(file, file, find)


def _unpacked(file: Path, source: Path, find: Find) -> Iterator[tuple[Track, int, bytes]]:
    """Yield the messages of a file that is none of compressed data; its messages may be."""
    read = mcap_records.messages if file.suffix.lower() == ".mcap" else _stored
    for track, logged, data in read(file, source, find):
        compressed = data[:4] == _BEGINNING
        yield track, logged, _decompressed(source, track, data) if compressed else data


def _stored(file: Path, source: Path, find: Find) -> Iterator[tuple[Track, int, bytes]]:
    """Yield what the library for bags reads, from a .bag or .db3."""
    kind = file.suffix.lower()
    version = 1 if kind == ".bag" else 2
    for ending in _JOURNALS if version == 2 else ():
        journal = file.with_name(file.name + ending)
        if journal.exists() and journal.stat().st_size:
            raise RecordingError(
                f"{file}: its recorder has not closed it: what {journal.name} holds is not in it "
                f"yet; end the recorder, or `sqlite3 {file.name} .tables` takes it in"
            )
    module = imported(f"rosbags.rosbag{version}", "ros", READING)
    count = 0
    try:
        with module.Reader(file) as reader:
            tracks = {c.id: find(_topic(c, version)) for c in reader.connections if c.msgcount}
            wanted = [c for c in reader.connections if tracks.get(c.id) is not None]
            for connection, logged, data in reader.messages(wanted) if wanted else ():
                count += 1
                track = tracks[connection.id]
                assert track is not None
                yield track, logged, bytes(data)
    except MotioneseError:
        raise
    # What the library raises depends on which byte is damaged.
    except Exception as error:
        raise RecordingError(
            f"{source}: not a bag of ROS {version}, not closed by its recorder, or damaged after "
            f"{count} messages ({why(error)}); {_REINDEX[kind]} saves what is whole"
        ) from error


def _topic(connection: Any, version: int) -> Topic:
    told, kind = connection.msgdef, connection.msgtype
    encoding = "ros1" if version == 1 else connection.ext.serialization_format
    return Topic(connection.topic, kind, encoding, told.data, told.format.name.lower())


def _decompress(file: Path, whole: Path) -> None:
    zstandard = imported("zstandard", "ros", f"reading {COMPRESSED}")
    try:
        with file.open("rb") as source, whole.open("wb") as target:
            zstandard.ZstdDecompressor().copy_stream(source, target)
    except (OSError, zstandard.ZstdError) as error:
        raise RecordingError(f"{file}: cannot be decompressed: {why(error)}") from error


def _decompressed(file: Path, track: Track, data: bytes) -> bytes:
    zstandard = imported("zstandard", "ros", f"reading {COMPRESSED}")
    try:
        whole: bytes = zstandard.ZstdDecompressor().decompress(data)
    except (MemoryError, zstandard.ZstdError) as error:
        raise RecordingError(
            f"{file}: a message of topic {track.topic.name} cannot be decompressed: {why(error)}"
        ) from error
    return whole
