"""The messages of an MCAP file, chunk by chunk; what nobody asks for is passed over unread."""

import zlib
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from struct import Struct
from typing import IO, Any

from motionese.errors import MotioneseError, RecordingError, needs
from motionese.recordings.formats.conventions import imported, why
from motionese.recordings.formats.mcap_writing import METADATA_KEY
from motionese.recordings.formats.message_log import Find, Topic, Track
from motionese.recordings.formats.ros_types import normalized

MAGIC = b"\x89MCAP0\r\n"
FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, DATA_END = 2, 3, 4, 5, 6, 15
"""Kinds of records."""
_HEAD = Struct("<BQ")
"""Of a record: its kind and length."""
_MESSAGE = Struct("<HIQQ")
"""Of a message: channel, sequence number, time of recording, time of publishing."""
_CRC = Struct("<I")


def messages(file: Path, source: Path, find: Find) -> Iterator[tuple[Track, int, bytes]]:
    """Yield the messages of the topics that `find` wants, with their log times [ns], in order.

    Errors name `source`, from which the file may have been unpacked.

    Raises:
        RecordingError: A file that is no MCAP file, is cut short, or damaged.
        MissingPackageError: The package for MCAP, or for its compression, is missing.
    """
    channels, count = _Channels(find), 0
    try:
        with file.open("rb") as stream:
            # No record is longer than its file: a damaged length must not fill the memory.
            for kind, content in _unpacked(_records(stream, file.stat().st_size)):
                if kind != MESSAGE:
                    channels.learn(kind, content)
                    continue
                count += 1
                channel, _, logged, _ = _MESSAGE.unpack_from(content)
                track = channels.track(channel)
                if track is not None:
                    yield track, logged, bytes(content[_MESSAGE.size :])
    except MotioneseError:
        raise
    # What the parser and its decompressors raise depends on which byte is damaged.
    except Exception as error:
        raise RecordingError(
            f"{source}: not an MCAP file, cut short, or damaged after {count} messages "
            f"({why(error)}); `mcap recover` saves what is whole"
        ) from error


def _records(stream: IO[bytes], size: int) -> Iterator[tuple[int, bytes]]:
    """Yield kind and content of every record of a file of this size [bytes], sums checked."""
    if (magic := stream.read(len(MAGIC))) != MAGIC:
        raise ValueError("it does not begin as one")
    checksum, kind = zlib.crc32(magic), 0
    while kind != FOOTER:
        head = stream.read(_HEAD.size)
        kind, length = _HEAD.unpack(head)
        content = stream.read(min(length, size))
        if len(content) != length:
            raise EOFError("a record is cut short")
        if kind == DATA_END:
            _check(content[:4], checksum)
        checksum = zlib.crc32(content, zlib.crc32(head, checksum))
        yield kind, content
    if stream.read(len(MAGIC)) != MAGIC:
        raise ValueError("it does not end as one")


def _unpacked(records: Iterator[tuple[int, bytes]]) -> Iterator[tuple[int, memoryview]]:
    """Yield the records that stand alone and those in chunks."""
    for kind, content in records:
        if kind != CHUNK:
            yield kind, memoryview(content)
            continue
        whole = memoryview(_decompressed(content))
        at = 0
        while at < len(whole):
            inner, length = _HEAD.unpack_from(whole, at)
            at += _HEAD.size
            if at + length > len(whole):
                raise EOFError("a record is cut short")
            yield inner, whole[at : at + length]
            at += length


def _decompressed(content: bytes) -> bytes:
    stream_reader = imported("mcap.stream_reader", "mcap", "reading MCAP")
    chunk = imported("mcap.records", "mcap", "reading MCAP").Chunk.read(_stream(content))
    try:
        stream, length = stream_reader.get_chunk_data_stream(chunk, validate_crc=True)
    except imported("mcap.exceptions", "mcap", "reading MCAP").UnsupportedCompressionError as error:
        raise needs(why(error).split()[-1], "mcap", "reading this MCAP file") from error
    whole: bytes = stream.read(length)
    return whole


def _check(told: bytes, checksum: int) -> None:
    (expected,) = _CRC.unpack(told)
    if expected not in (0, checksum):
        raise ValueError(f"checksum {checksum} where it tells {expected}")


def _stream(content: bytes) -> Any:
    module = imported("mcap.data_stream", "mcap", "reading MCAP")
    return module.ReadDataStream(BytesIO(content))


class _Channels:
    """Which track belongs to a channel's number, found when the channel first speaks."""

    def __init__(self, find: Find) -> None:
        self._find = find
        self._records = imported("mcap.records", "mcap", "reading MCAP")
        self._schemas: dict[int, Any] = {}
        self._channels: dict[int, Any] = {}
        self._tracks: dict[int, Track | None] = {}

    def learn(self, kind: int, content: memoryview) -> None:
        """Take in a record, should it be of a channel or a schema."""
        if kind == CHANNEL:
            record = self._records.Channel.read(_stream(bytes(content)))
            self._channels[record.id] = record
        elif kind == SCHEMA:
            record = self._records.Schema.read(_stream(bytes(content)))
            self._schemas[record.id] = record

    def track(self, channel: int) -> Track | None:
        """Return where a channel's messages go; None where nobody asks for them."""
        if channel not in self._tracks:
            self._tracks[channel] = self._find(self._topic(channel))
        return self._tracks[channel]

    def _topic(self, channel: int) -> Topic:
        told = self._channels[channel]
        schema, metadata = self._schemas.get(told.schema_id), told.metadata.get(METADATA_KEY)
        if schema is None:
            return Topic(told.topic, "", told.message_encoding, metadata=metadata)
        kind, definition = normalized(schema.name), schema.data.decode(errors="replace")
        return Topic(told.topic, kind, told.message_encoding, definition, schema.encoding, metadata)
