"""MCAP with JSON messages: one file an episode, a folder of files a recording.

Channels are named TOPIC.a.b by where the number stands in the message (see `numbers`).
Messages in other encodings are left alone. A topic that we wrote carries in its MCAP channel's
metadata what JSON cannot say (names, units, rate, the episode's name); its channels keep their
plain names.
"""

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.formats.conventions import (
    WIDEST,
    imported,
    is_bookkeeping,
    natural,
    strings,
    times_unless_even,
)
from motionese.recordings.formats.mcap_writing import METADATA_KEY, TopicMetadata, write
from motionese.recordings.rate import rate_of_times
from motionese.recordings.recording import Episode, Recording

__all__ = ["read", "write"]


@dataclass
class _Tape:
    """What one file holds: numbers by channel and log time [ns]."""

    metadata: TopicMetadata
    samples: dict[str, dict[int, float]] = field(default_factory=dict)
    stamps: dict[str, set[int]] = field(default_factory=dict)
    """Log times [ns] of the messages of every topic that holds numbers."""
    bookkeeping: set[str] = field(default_factory=set)


def read(path: Path) -> Recording:
    """Read one .mcap file as one episode, or a folder of them, in natural order.

    Rows are the times at which any of the topics spoke, counted from the file's first message;
    a channel is observed where its own topic did. The rate is that of the topic with the most
    messages. All channels but headers, stamps and sequence numbers are usual.
    """
    files = [path] if path.is_file() else sorted(path.glob("*.mcap"), key=lambda f: natural(f.name))
    if not files:
        raise RecordingError(f"{path}: holds no .mcap files")
    tapes = [_read_tape(file) for file in files]
    channels = tuple(dict.fromkeys(n for t in tapes for n in (*t.metadata.channels, *t.samples)))
    told = [t.metadata for t in tapes]
    units = {name: unit for m in told for name, unit in zip(m.channels, m.units, strict=False)}
    bookkeeping = set.union(*(t.bookkeeping for t in tapes))
    return Recording(
        source=path,
        channels=channels,
        units=tuple(units.get(name, "") for name in channels),
        ranges={},
        rate_hz=_rate(tapes),
        episodes=tuple(_episode(tape, channels) for tape in tapes),
        usual=tuple(n for n in channels if n not in bookkeeping) or channels,
    )


def numbers(value: Any, path: str = "") -> Iterator[tuple[str, float]]:
    """Yield (path, number) for every number in `value`: `.a.b` in objects, `.a[0]` in arrays.

    An object with a list of strings `name`, such as a JointState, names the columns of its other
    lists of that length: `.position.elbow`. Truth values, text and null are no numbers.
    """
    if isinstance(value, dict):
        labels = strings(value.get("name")) or ()
        labels = labels if len(set(labels)) == len(labels) else ()
        for key, part in value.items():
            if labels and isinstance(part, list) and len(part) == len(labels):
                for label, item in zip(labels, part, strict=True):
                    yield from numbers(item, f"{path}.{key}.{label}")
            else:
                yield from numbers(part, f"{path}.{key}")
    elif isinstance(value, list):
        if len(value) <= WIDEST:
            for i, item in enumerate(value):
                yield from numbers(item, f"{path}[{i}]")
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield path, float(value)


def _read_tape(file: Path) -> _Tape:
    tape = _Tape(TopicMetadata(episode=file.stem, channels=(), units=(), rate_hz=None))
    topics: dict[int, Any] = {}
    for record in _records(file):
        if hasattr(record, "message_encoding"):
            topics[record.id] = record
            if METADATA_KEY in record.metadata:
                tape.metadata = TopicMetadata.read(file, record.metadata[METADATA_KEY])
        elif hasattr(record, "channel_id"):
            topic = topics.get(record.channel_id)
            if topic is None or topic.message_encoding != "json":
                continue
            try:
                found = list(numbers(json.loads(record.data)))
            except (ValueError, OverflowError, RecursionError) as error:
                raise RecordingError(
                    f"{file}: topic {topic.topic}: the message at {record.log_time} ns is not "
                    f"JSON ({error})"
                ) from error
            _add(tape, topic, record.log_time, found)
    if not tape.stamps:
        encodings = sorted({topic.message_encoding for topic in topics.values()})
        raise RecordingError(
            f"{file}: no numbers in messages encoded as 'json'; "
            f"encodings in it: {', '.join(encodings) or 'none'}"
        )
    return tape


def _records(file: Path) -> Iterator[Any]:
    """Yield channels and messages in the file's order."""
    stream_reader = imported("mcap.stream_reader", "mcap", "reading MCAP")
    records, count = import_module("mcap.records"), 0
    try:
        with file.open("rb") as stream:
            size = file.stat().st_size
            # No record is longer than its file: a damaged length must not fill the memory.
            reader = stream_reader.StreamReader(stream, validate_crcs=True, record_size_limit=size)
            for record in reader.records:
                if isinstance(record, records.Channel | records.Message):
                    count += isinstance(record, records.Message)
                    yield record
    except Exception as error:
        # What the parser and its decompressors raise depends on which byte is damaged.
        raise RecordingError(
            f"{file}: not an MCAP file, cut short, or damaged after {count} messages "
            f"({str(error) or type(error).__name__}); `mcap recover` saves what is whole"
        ) from error


def _add(tape: _Tape, topic: Any, stamp: int, found: list[tuple[str, float]]) -> None:
    ours = METADATA_KEY in topic.metadata
    if found or ours:
        tape.stamps.setdefault(topic.topic, set()).add(stamp)
    for path, number in found:
        name = path.removeprefix(".") if ours else topic.topic + path
        if name not in tape.samples and not ours and is_bookkeeping(path):
            tape.bookkeeping.add(name)
        tape.samples.setdefault(name, {})[stamp] = number


def _rate(tapes: list[_Tape]) -> float | None:
    """Return the rate [Hz] that all files tell, or that of the topic with the most messages."""
    told = {t.metadata.rate_hz for t in tapes}
    if len(told) == 1 and None not in told:
        return told.pop()
    count = Counter(topic for t in tapes for topic, stamps in t.stamps.items() for _ in stamps)
    (densest, _), *_ = count.most_common(1)
    return rate_of_times([_since_first(sorted(t.stamps.get(densest, ()))) for t in tapes])


def _since_first(stamps: list[int]) -> Float[ndarray, " T"]:
    """Return log times [ns] as times [s] from the first; exact before they become floats."""
    return np.array([stamp - stamps[0] for stamp in stamps], dtype=np.float64) / 1e9


def _episode(tape: _Tape, channels: tuple[str, ...]) -> Episode:
    stamps = sorted(set.union(*tape.stamps.values()))
    row_at = {stamp: row for row, stamp in enumerate(stamps)}
    values = np.zeros((len(stamps), len(channels)))
    observed = np.zeros(values.shape, dtype=bool)
    for column, name in enumerate(channels):
        samples = tape.samples.get(name, {})
        rows = [row_at[stamp] for stamp in samples]
        values[rows, column] = list(samples.values())
        observed[rows, column] = True
    times = times_unless_even(_since_first(stamps), tape.metadata.rate_hz)
    return Episode(tape.metadata.episode, times, values, observed)
