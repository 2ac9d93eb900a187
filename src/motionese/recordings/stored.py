"""Recordings that stay where they are: what they tell, and their episodes, read one at a time."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import NamedTuple

from motionese.recordings.recording import Episode, Recording


@dataclass(frozen=True)
class StoredRecording:
    """A recording whose file stays open, as long as this is kept.

    Attributes:
        outline: All that the file tells but for what was recorded: its episodes have no rows.
        read: Reads the episode of that number, counted from 0.
    """

    outline: Recording
    read: Callable[[int], Episode]

    def whole(self, which: Iterable[int] | None = None) -> Recording:
        """Return the recording with all episodes read, or with some alone."""
        numbers = range(len(self.outline.episodes)) if which is None else which
        return replace(self.outline, episodes=tuple(map(self.read, numbers)))


class StoredEpisode(NamedTuple):
    """One episode that was looked through, and is read again when it is needed.

    Attributes:
        read: Reads it, made ready to be learned from.
        rows: How many rows it has.
        digest: Of its values and of what was observed.
    """

    read: Callable[[], Episode]
    rows: int
    digest: str
