"""Which topics of a log are read, and what is said where there are none."""

from collections.abc import Callable, Iterable, Sequence
from fnmatch import fnmatchcase
from pathlib import Path

from motionese.errors import RecordingError, SettingError, unknown
from motionese.recordings.formats.json_messages import JsonMessages
from motionese.recordings.formats.log_clock import settle_times
from motionese.recordings.formats.mcap_writing import TopicMetadata
from motionese.recordings.formats.message_log import Find, Log, Messages, Topic, Track
from motionese.recordings.formats.ros_messages import RosMessages
from motionese.recordings.formats.ros_types import UndefinedTypeError


class TopicChoice:
    """The topics that are read: those that fit any of some patterns, or all that tell a motion.

    The topic that marks takes is read as well.
    """

    def __init__(self, patterns: Sequence[str] | None, marker: str | None) -> None:
        patterns = (patterns,) if isinstance(patterns, str) else patterns
        self.patterns = None if patterns is None else tuple(patterns)
        self.marker = marker
        self.there: dict[str, str] = {}
        """All topics that said anything, with their types."""

    def read(
        self,
        source: Path,
        name: str,
        messages: Callable[[Find], Iterable[tuple[Track, int, bytes]]],
        distribution: str = "",
    ) -> Log:
        """Read a log whole.

        Args:
            source: For messages.
            name: Of the episode, if the log tells none.
            messages: Yields the messages that are asked for, with their times [ns].
            distribution: Of ROS, whose standard types it may hold.

        Raises:
            RecordingError: Nothing in it tells a motion, or a message is not what it should be.
        """
        log = Log(source, TopicMetadata(episode=name, channels=(), units=(), rate_hz=None))
        asked: dict[Topic, Track | None] = {}

        def find(topic: Topic) -> Track | None:
            if topic not in asked:
                asked[topic] = self._track(log, topic, distribution)
            return asked[topic]

        for track, logged, data in messages(find):
            (log.mark if self._marks(track.topic) else log.add)(track, logged, data)
        log.tracks = [t for t in asked.values() if t is not None and not self._marks(t.topic)]
        log.close()
        settle_times(log)
        if not log.tracks:
            if self.there and not log.left_out | log.undefined:
                self.check(source)
            raise RecordingError(f"{source}: {self._nothing(log)}")
        return log

    def check(self, source: Path, logs: Sequence[Log] = ()) -> None:
        """Check that every pattern fits a topic, and the marker one of every log.

        Raises:
            SettingError: A pattern or marker that fits no topic at all.
            RecordingError: A log in which nothing was said on the marker's topic.
        """
        for pattern in (*(self.patterns or ()), *([self.marker] if self.marker else [])):
            if not any(_fits(name, pattern) for name in self.there):
                raise SettingError(f"{source}: {unknown('topic', pattern, self.there)}")
        for log in logs:
            if self.marker is not None and not log.marks:
                raise RecordingError(f"{log.source}: nothing was said on its topic {self.marker}")

    def _marks(self, topic: Topic) -> bool:
        return self.marker is not None and _fits(topic.name, self.marker)

    def _track(self, log: Log, topic: Topic, distribution: str) -> Track | None:
        """Return where the messages of a topic go; None where they are left out."""
        self.there[topic.name] = topic.kind or topic.encoding
        marks, patterns = self._marks(topic), self.patterns
        asked = marks or any(_fits(topic.name, pattern) for pattern in patterns or ())
        if patterns is not None and not asked:
            return None
        try:
            messages = _messages(topic, distribution)
        except UndefinedTypeError:
            log.undefined[topic.name] = topic.kind
            return None
        if messages is None:
            log.left_out[topic.name] = f"{topic.kind} as {topic.encoding}".strip()
        elif isinstance(messages, RosMessages) and not (
            marks or (messages.hold_numbers if asked else messages.hold_motion)
        ):
            log.left_out[topic.name] = topic.kind
        else:
            if topic.metadata is not None:
                log.told = TopicMetadata.read(log.source, topic.metadata)
            return Track(topic, messages)
        return None

    def _nothing(self, log: Log) -> str:
        """Return in words why nothing was read."""
        for name, kind in log.undefined.items():
            return (
                f"topic {name} is of type {kind}, which is defined neither there "
                "nor among the standard types of ROS"
            )
        if not self.there:
            return "holds no messages"
        there = ", ".join(f"{name} ({kind})" for name, kind in self.there.items())
        return f"no numbers of a motion in what is read of it (--topic); topics: {there}"


def _messages(topic: Topic, distribution: str) -> Messages | None:
    if topic.encoding == "json":
        return JsonMessages()
    return RosMessages(topic, distribution) if topic.encoding in ("cdr", "ros1") else None


def _fits(name: str, pattern: str) -> bool:
    return name == pattern or any(fnmatchcase(name, p) for p in (pattern, f"/{pattern}"))
