"""What the topics of a log said and when, while it is read.

Messages of a topic that hold the same numbers are kept together, as rows of plain arrays.
"""

from array import array
from collections.abc import Callable, Collection, Hashable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding, Kind
from motionese.recordings.formats.conventions import WIDEST, why
from motionese.recordings.formats.mcap_writing import TopicMetadata
from motionese.recordings.formats.takes import Mark


class Topic(NamedTuple):
    """A topic of a log: what its messages are, and how they are written.

    Attributes:
        kind: Their type; empty where the log tells none.
        encoding: "json", "cdr" or "ros1"; others are not read.
        definition: Of the type; empty where the log tells none.
        grammar: In which that is written, such as "ros2msg" or "ros2idl".
        metadata: What we told of the topic if we wrote it.
    """

    name: str
    kind: str
    encoding: str
    definition: str = ""
    grammar: str = ""
    metadata: str | None = None


@runtime_checkable
class Messages(Protocol):
    """How the messages of one topic are decoded; whatever is wrong with one may be raised."""

    @property
    def further(self) -> Sequence[tuple[int, list[float]]]:
        """What the first message says of several times: after how many ns, and the numbers."""
        ...

    @property
    def shortened(self) -> int:
        """Messages of which `numbers` gave the first of several times alone."""
        ...

    @property
    def wide(self) -> Collection[str]:
        """Paths of lists that are left out, as they are too wide to be of a motion."""
        ...

    def value(self, data: bytes) -> Any:
        """Return what a message says, as a number, text, or an object with fields."""
        ...

    def numbers(self, data: bytes) -> tuple[Hashable, int, list[float]]:
        """Return what messages with the same columns have in common, stamp [ns], and numbers."""
        ...

    def columns(self) -> list[tuple[str, str, bool]]:
        """Return path, unit and whether it is usual, of every number of the last message."""
        ...


@dataclass
class Rows:
    """Messages with the same numbers: when each was recorded and stamped [ns], and the numbers."""

    channels: tuple[str, ...]
    logged: "array[int]" = field(default_factory=lambda: array("q"))
    stamped: "array[int]" = field(default_factory=lambda: array("q"))
    numbers: "array[float]" = field(default_factory=lambda: array("d"))

    def column(self, index: int) -> Float[ndarray, " M"]:
        """Return the numbers of one channel."""
        return np.asarray(self.numbers)[index :: len(self.channels)]


@dataclass(eq=False)
class Track:
    """What one topic said."""

    topic: Topic
    messages: Messages
    alike: dict[Hashable, Rows] = field(default_factory=dict)

    @property
    def rows(self) -> Iterable[Rows]:
        """What was said, by which numbers it was."""
        return self.alike.values()

    def count(self) -> int:
        """Return the number of messages."""
        return sum(len(rows.logged) for rows in self.rows)

    def lay_out(self) -> None:
        """Lay out the topic's only message over the times that it speaks of."""
        (rows,) = self.rows
        logged, stamped, further = rows.logged[0], rows.stamped[0], self.messages.further
        rows.logged = array("q", (logged + after for after, _ in further))
        rows.stamped = array("q", (stamped + after if stamped else 0 for after, _ in further))
        rows.numbers = array("d", (number for _, numbers in further for number in numbers))

    def offsets(self) -> Int[ndarray, " M"]:
        """Return by how much every message was recorded after its stamp [ns]."""
        return np.concatenate([whole(r.logged) - whole(r.stamped) for r in self.rows])


Find = Callable[[Topic], Track | None]
"""What is asked of every topic of a log before its messages are read: where they go, if anywhere.
"""


@dataclass
class Log:
    """A log while it is read, and after.

    Attributes:
        source: For messages.
        told: The episode's name, and what we told of its channels if we wrote it.
        tracks: What topics said, in the order in which they first spoke.
        rows: The same, in the order in which its numbers were first met.
        columns: Unit of every channel, and whether it is usual.
        left_out: Topics that are left out, with their types.
        undefined: Topics whose types nothing defines, with these types.
        marks: What was said on the topic that marks the takes.
    """

    source: Path
    told: TopicMetadata
    tracks: list[Track] = field(default_factory=list)
    rows: list[Rows] = field(default_factory=list)
    columns: dict[str, tuple[str, bool]] = field(default_factory=dict)
    left_out: dict[str, str] = field(default_factory=dict)
    undefined: dict[str, str] = field(default_factory=dict)
    marks: list[Mark] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)

    def add(self, track: Track, logged: int, data: bytes) -> None:
        """Take in a message of a topic; `RecordingError` where it is not what the topic says."""
        try:
            alike, stamped, found = track.messages.numbers(data)
            if not found and track.topic.metadata is None:
                return
            rows = track.alike.get(alike)
            if rows is None:
                rows = track.alike[alike] = self._first_rows(track)
            rows.logged.append(logged)
            rows.stamped.append(stamped)
            rows.numbers.extend(found)
        # What a decoder raises depends on what is wrong.
        except Exception as error:
            raise self._no_message(track.topic, logged, error) from error

    def mark(self, track: Track, logged: int, data: bytes) -> None:
        """Take in a message that marks where takes begin and end."""
        try:
            self.marks.append(Mark.of(logged, track.messages.value(data)))
        except Exception as error:
            raise self._no_message(track.topic, logged, error) from error

    def _no_message(self, topic: Topic, logged: int, error: Exception) -> RecordingError:
        """Return the error for a message that cannot be decoded."""
        what = "JSON" if topic.encoding == "json" else topic.kind
        return RecordingError(
            f"{self.source}: topic {topic.name}: the message at {logged} ns is not {what} "
            f"({why(error)})"
        )

    def close(self) -> None:
        """Leave the topics that told any numbers; tell what of the others is left out."""
        for track in self.tracks:
            self._settle(track)
        self.tracks = [track for track in self.tracks if track.count()]

    def _settle(self, track: Track) -> None:
        """Lay out a topic's only message, where it speaks of several times; tell what is left."""
        topic, count, messages = track.topic, track.count(), track.messages
        if not count and topic.encoding != "json":
            self.left_out[topic.name] = topic.kind
        if count == 1 and messages.further:
            track.lay_out()
        elif messages.shortened:
            what = f"topic {topic.name}: of every message the first point alone is taken"
            self.found("left out", what, count=messages.shortened)
        if count and messages.wide:
            listed = ", ".join(messages.wide)
            what = f"topic {topic.name}: lists of more than {WIDEST} numbers are left out: {listed}"
            self.found("left out", what)

    def times(self, which: Callable[[Rows], bool] = lambda _: True) -> Int[ndarray, " T"]:
        """Return the times [ns] at which anything was said, each once, in order."""
        said = [whole(rows.logged) for rows in self.rows if which(rows)]
        return np.unique(np.concatenate([*said, np.empty(0, np.int64)]))

    def _first_rows(self, track: Track) -> Rows:
        is_ours = track.topic.metadata is not None
        names = []
        for path, unit, usual in track.messages.columns():
            names.append(path.removeprefix(".") if is_ours else track.topic.name + path)
            self.columns.setdefault(names[-1], (unit, usual or is_ours))
        self.rows.append(Rows(tuple(names)))
        return self.rows[-1]

    def found(self, kind: Kind, what: str, **told: Any) -> None:
        """Note a finding."""
        self.findings.append(Finding(kind, self.source, what, **told))


def whole(numbers: "array[int]") -> Int[ndarray, " M"]:
    """Return whole numbers as NumPy's, without a copy."""
    return np.asarray(numbers).view(np.int64)
