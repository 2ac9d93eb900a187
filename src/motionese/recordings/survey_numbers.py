"""The numbers in which a recording is shown: of the whole, of an episode, of a channel."""

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class EpisodeNumbers:
    """One episode.

    Attributes:
        name: Its name.
        rows: How many there are.
        duration_s: From the first row to the last [s]; None where no time or rate is told.
        still_start: Share of its rows at the start in which nothing moves yet.
        still_end: Share of its rows at the end in which nothing moves any more.
        still: Share of its steps from row to row in which nothing moves.
        unobserved: Share of its cells in which nothing was observed.
        holes: How often its times leave out a row or more.
        nan: Cells with a NaN.
        infinite: Cells with an infinite value.
    """

    name: str
    rows: int
    duration_s: float | None
    still_start: float
    still_end: float
    still: float
    unobserved: float
    holes: int
    nan: int
    infinite: int


@dataclass(frozen=True)
class ChannelNumbers:
    """One channel over all episodes.

    Attributes:
        name: Its name.
        unit: Its unit; empty where unknown.
        usual: Whether it is taken when no channels are chosen.
        low: Lowest finite value [its unit]; None where there is none.
        high: Highest finite value [its unit]; None where there is none.
        mean_step: Mean change from row to row [its unit]; None without two rows in a row.
        still: Share of its steps from row to row in which it does not move.
        unobserved: Share of rows in which it was not observed.
        nan: Rows with a NaN.
        infinite: Rows with an infinite value.
        given: The range that the file tells, if it does.
    """

    name: str
    unit: str
    usual: bool
    low: float | None
    high: float | None
    mean_step: float | None
    still: float
    unobserved: float
    nan: int
    infinite: int
    given: tuple[float, float] | None


@dataclass(frozen=True)
class Survey:
    """A whole recording.

    Attributes:
        source: The file or folder.
        rate_hz: Rows per second that the file or its times tell; None where neither does.
        jitter: Largest deviation of an interval from the usual one, as a share of it, holes left
            aside; None without times.
        episodes: One row of numbers an episode.
        channels: One row of numbers a channel.
    """

    source: Path
    rate_hz: float | None
    jitter: float | None
    episodes: tuple[EpisodeNumbers, ...]
    channels: tuple[ChannelNumbers, ...]
