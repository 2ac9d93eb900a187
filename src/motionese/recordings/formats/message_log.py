"""What the topics of a log said and when, and how it becomes the rows of episodes.

Messages of a topic that hold the same numbers are kept together, as rows of plain arrays. A topic
counts by the stamps in its messages' headers where all have one and they rise, else by the times
at which its messages were recorded.
"""

from array import array
from collections import Counter
from collections.abc import Callable, Collection, Hashable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.finding import Finding, Kind
from motionese.recordings.formats.conventions import WIDEST, times_unless_even, why
from motionese.recordings.formats.mcap_writing import TopicMetadata
from motionese.recordings.formats.takes import Cuts, Mark
from motionese.recordings.rate import rate_of_times
from motionese.recordings.recording import Episode, Recording

LATE_NS = 1_000_000_000
"""By so much [ns] may a header's stamp be off the time of recording and still be of one clock."""


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


@dataclass
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
        return np.concatenate([_whole(r.logged) - _whole(r.stamped) for r in self.rows])


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
            raise self.no_message(track.topic, logged, error) from error

    def mark(self, track: Track, logged: int, data: bytes) -> None:
        """Take in a message that marks where takes begin and end."""
        try:
            self.marks.append(Mark.of(logged, track.messages.value(data)))
        except Exception as error:
            raise self.no_message(track.topic, logged, error) from error

    def no_message(self, topic: Topic, logged: int, error: Exception) -> RecordingError:
        """Return the error for a message that cannot be decoded."""
        what = "JSON" if topic.encoding == "json" else topic.kind
        return RecordingError(
            f"{self.source}: topic {topic.name}: the message at {logged} ns is not {what} "
            f"({why(error)})"
        )

    def close(self) -> None:
        """Decide what counts as the time of every message; it is then in `Rows.logged`."""
        for track in self.tracks:
            self._settle(track)
        self.tracks = [track for track in self.tracks if track.count()]
        by_stamp, behind = self._clock()
        self.marks = [mark._replace(time=mark.time - behind) for mark in self.marks]
        for track in self.tracks:
            for rows in track.rows:
                rows.logged = rows.stamped if track in by_stamp else rows.logged
                rows.stamped = array("q")

    def _settle(self, track: Track) -> None:
        """Lay out a topic's only message, where it speaks of several times; tell what is left."""
        topic, count, messages = track.topic, track.count(), track.messages
        if not count and topic.encoding != "json":
            self.left_out[topic.name] = topic.kind
        if count == 1 and messages.further:
            track.lay_out()
        elif messages.shortened:
            what = f"topic {topic.name}: of every message the first point alone is taken"
            self._found("left out", what, count=messages.shortened)
        if count and messages.wide:
            listed = ", ".join(messages.wide)
            what = f"topic {topic.name}: lists of more than {WIDEST} numbers are left out: {listed}"
            self._found("left out", what)

    def times(self, which: Callable[[Rows], bool] = lambda _: True) -> Int[ndarray, " T"]:
        """Return the times [ns] at which anything was said, each once, in order."""
        said = [_whole(rows.logged) for rows in self.rows if which(rows)]
        return np.unique(np.concatenate([*said, np.empty(0, np.int64)]))

    def _first_rows(self, track: Track) -> Rows:
        is_ours = track.topic.metadata is not None
        names = []
        for path, unit, usual in track.messages.columns():
            names.append(path.removeprefix(".") if is_ours else track.topic.name + path)
            self.columns.setdefault(names[-1], (unit, usual or is_ours))
        self.rows.append(Rows(tuple(names)))
        return self.rows[-1]

    def _clock(self) -> tuple[list[Track], int]:
        """Return the topics that count by their stamps, and how far these are behind [ns]."""
        stamped = []
        for track in self.tracks:
            stamps = [_whole(rows.stamped) for rows in track.rows]
            if all((s != 0).all() and (np.diff(s) > 0).all() for s in stamps):
                stamped.append(track)
            elif any(s.any() for s in stamps):
                self._found(
                    "time",
                    f"topic {track.topic.name}: the stamps in its headers are not all there, or do "
                    "not rise; the times at which its messages were recorded are taken",
                )
        offsets = {track.topic: track.offsets() for track in stamped}
        behind = {topic: int(np.median(late)) for topic, late in offsets.items()}
        far = [
            topic
            for topic, late in offsets.items()
            if max(abs(behind[topic]), abs(int(late[-1] - late[0]))) > LATE_NS
        ]
        if not far:
            return stamped, 0
        one = len(stamped) == len(self.tracks)
        one = one and max(behind.values()) - min(behind.values()) <= LATE_NS
        size = max((behind[topic] for topic in far), key=abs) / 1e9
        self._found(
            "time",
            f"the stamps in the headers of {', '.join(topic.name for topic in far)} are not of the "
            f"clock by which they were recorded ({size:.6g} s behind it); the "
            f"{'stamps' if one else 'times at which they were recorded'} are taken",
            size=size,
        )
        if one:
            return stamped, int(np.median(list(behind.values())))
        return [track for track in stamped if track.topic not in far], 0

    def _found(self, kind: Kind, what: str, **told: Any) -> None:
        self.findings.append(Finding(kind, self.source, what, **told))


def recording_of(path: Path, logs: list[Log], cuts: Cuts) -> Recording:
    """Return the recording of closed logs, cut into takes. The logs are used up.

    Rows are the times at which any of the topics spoke, counted from the episode's first; a
    channel is observed where its own topic did. The rate is that of the usual channel that was
    said most often.
    """
    names = ((*log.told.channels, *(n for r in log.rows for n in r.channels)) for log in logs)
    channels = tuple(dict.fromkeys(name for each in names for name in each))
    columns = {name: told for log in logs for name, told in log.columns.items()}
    units = {name: unit for name, (unit, _) in columns.items()}
    for log in logs:
        units |= dict(zip(log.told.channels, log.told.units, strict=False))
    usual = tuple(n for n in channels if n not in columns or columns[n][1]) or channels
    rate = _rate(logs, usual)
    episodes = [episode for log in logs for episode in _episodes(log, channels, cuts)]
    return Recording(
        source=path,
        channels=channels,
        units=tuple(units.get(name, "") for name in channels),
        ranges={},
        rate_hz=rate,
        episodes=cuts.named(episodes),
        usual=usual,
        findings=(*_left_out(path, logs), *(found for log in logs for found in log.findings)),
    )


def _left_out(path: Path, logs: list[Log]) -> list[Finding]:
    """Return what was left out, all in one."""
    topics: dict[str, dict[str, None]] = {}
    for log in logs:
        undefined = {n: f"{kind}, defined nowhere" for n, kind in log.undefined.items()}
        for name, kind in (log.left_out | undefined).items():
            topics.setdefault(kind, {})[name] = None
    if not topics:
        return []
    listed = "; ".join(f"{', '.join(names)} ({kind})" for kind, names in topics.items())
    what = f"topics that tell no motion are left out: {listed}"
    return [Finding("left out", path, what, "--topic names those that are to be read")]


def _rate(logs: list[Log], usual: Sequence[str]) -> float | None:
    """Return the rate [Hz] that all logs tell, or that of the channel said most often."""
    told = {log.told.rate_hz for log in logs}
    if len(told) == 1 and None not in told:
        return told.pop()
    count = Counter[str]()
    for rows in (rows for log in logs for rows in log.rows):
        count.update(dict.fromkeys(rows.channels, len(rows.logged)))
    densest = max(usual, key=lambda name: count[name])
    each = [log.times(lambda rows: densest in rows.channels) for log in logs]
    return rate_of_times([_since_first(times) for times in each])


def _whole(numbers: "array[int]") -> Int[ndarray, " M"]:
    return np.asarray(numbers).view(np.int64)


def _since_first(times: Int[ndarray, " T"]) -> Float[ndarray, " T"]:
    """Return times [ns] as times [s] from the first; exact before they become floats."""
    return np.asarray((times - times[:1]) / 1e9)


def _episodes(log: Log, channels: tuple[str, ...], cuts: Cuts) -> list[Episode]:
    times, column = log.times(), {name: i for i, name in enumerate(channels)}
    values = np.zeros((len(times), len(channels)))
    observed = np.zeros(values.shape, dtype=bool)
    twice = 0
    for rows in log.rows:
        at = np.searchsorted(times, _whole(rows.logged))
        for i, name in enumerate(rows.channels):
            values[at, column[name]] = rows.column(i)
        if rows.channels:
            seen = observed[:, column[rows.channels[0]]]
            twice += len(at) - int((~seen[np.unique(at)]).sum())
        for name in rows.channels:
            observed[at, column[name]] = True
    log.rows.clear()
    log.tracks.clear()
    if twice:
        what = f"{twice} messages are at the time of another of their topic; the last one counts"
        log.findings.append(Finding("left out", log.source, what))
    takes, found = cuts.takes(log.source, log.told.episode, times, log.marks)
    log.findings += found
    rate = log.told.rate_hz
    return [
        Episode(n, times_unless_even(_since_first(times[p]), rate), values[p], observed[p])
        for n, p in takes
    ]
