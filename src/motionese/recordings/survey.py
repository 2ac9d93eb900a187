"""What is in a recording, in numbers, whatever is wrong with it: what a user looks at first."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.recordings.preparation import still_ends
from motionese.recordings.rate import DROPPED, rate_of_times
from motionese.recordings.recording import BLOCK, Episode, Recording

STILL_END = 0.01
"""Share of its range within which every channel stays in the still rows at an episode's ends."""
STILL_STEP = 0.001
"""Share of its range by which a channel that is still changes at most from row to row."""


class EpisodeNumbers(NamedTuple):
    """One episode: how many `rows` it has, how many of its cells are NaN or infinite.

    Attributes:
        duration_s: From the first row to the last [s]; None where no time or rate is told.
        still_start: Share of its rows at the start in which nothing moves yet.
        still_end: Share of its rows at the end in which nothing moves any more.
        still: Share of its steps from row to row in which nothing moves.
        unobserved: Share of its cells in which nothing was observed.
        holes: How often its times leave out a row or more.
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


class ChannelNumbers(NamedTuple):
    """One channel over all episodes, in how many rows it is NaN or infinite.

    Attributes:
        unit: Empty where unknown.
        usual: Whether it is taken when no channels are chosen.
        low, high: Extremes of its finite values [its unit]; None where there are none.
        mean_step: Mean change from row to row [its unit]; None without two rows in a row.
        still: Share of its steps from row to row in which it does not move.
        unobserved: Share of rows in which it was not observed.
        given: The range that the file tells, if it does.
        binary: Whether it takes two values.
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
    binary: bool


class Survey(NamedTuple):
    """A whole recording.

    Attributes:
        rate_hz: Rows per second that the file or its times tell; None where neither does.
        jitter: Largest deviation of an interval from the usual one, as a share of it, holes left
            aside; None without times.
    """

    source: Path
    rate_hz: float | None
    jitter: float | None
    episodes: tuple[EpisodeNumbers, ...]
    channels: tuple[ChannelNumbers, ...]


class _Cells(NamedTuple):
    """Extremes of the finite values of every channel in one episode, and how many are which."""

    low: Float[ndarray, " D"]
    high: Float[ndarray, " D"]
    unobserved: Int[ndarray, " D"]
    nan: Int[ndarray, " D"]
    infinite: Int[ndarray, " D"]

    @property
    def whole(self) -> bool:
        """Whether all was observed and is finite."""
        return not (self.unobserved.any() or self.nan.any() or self.infinite.any())


class _Steps(NamedTuple):
    """Steps from row to row of every channel in one episode: sum, number, and how many are still.

    Attributes:
        all_still: Share of them in which no usual channel moves.
    """

    total: Float[ndarray, " D"]
    number: Int[ndarray, " D"]
    still: Int[ndarray, " D"]
    all_still: float


# What is absurd is shown, not refused: differences of huge values may overflow.
@np.errstate(over="ignore", invalid="ignore")
def survey(recording: Recording) -> Survey:
    """Return the numbers of a recording as it was read, before anything is refused or mended."""
    episodes = recording.episodes
    cells = list(map(_cells, episodes))
    low = np.min([c.low for c in cells], axis=0)
    high = np.max([c.high for c in cells], axis=0)
    widths = np.where(low <= high, high, 0.0) - np.where(low <= high, low, 0.0)
    usual = [i for i, c in enumerate(recording.channels) if c in recording.usual]
    times = [e.times for e in episodes if e.times is not None]
    rising = [t for t in times if np.isfinite(t).all() and (np.diff(t) > 0).all()]
    rate = recording.rate_hz if recording.rate_hz is not None else rate_of_times(rising)
    steps = [
        _steps(e, STILL_STEP * widths, usual, whole=c.whole)
        for e, c in zip(episodes, cells, strict=True)
    ]
    return Survey(
        recording.source,
        rate,
        _jitter(rising, rate),
        tuple(
            _episode(e, c, s, STILL_END * widths, usual, rate)
            for e, c, s in zip(episodes, cells, steps, strict=True)
        ),
        tuple(_channel(recording, i, cells, steps) for i in range(len(recording.channels))),
    )


def _episode(
    episode: Episode,
    cells: _Cells,
    steps: _Steps,
    limits: Float[ndarray, " D"],
    usual: list[int],
    rate: float | None,
) -> EpisodeNumbers:
    rows, times = len(episode.values), episode.times
    shown = episode.part(columns=usual)
    if not cells.whole:
        shown = replace(shown, observed=shown.observed & np.isfinite(shown.values))
    start, end = still_ends(shown, limits[usual]) if usual else (0, 0)
    duration = None if rate is None else max(rows - 1, 0) / rate
    if times is not None and rows:
        duration = float(times[-1] - times[0])
    return EpisodeNumbers(
        episode.name,
        rows,
        duration,
        start / max(rows, 1),
        end / max(rows, 1),
        steps.all_still,
        int(cells.unobserved.sum()) / max(episode.values.size, 1),
        0 if times is None or rate is None else int((np.diff(times) * rate > DROPPED).sum()),
        int(cells.nan.sum()),
        int(cells.infinite.sum()),
    )


def _channel(
    recording: Recording, column: int, cells: Sequence[_Cells], steps: Sequence[_Steps]
) -> ChannelNumbers:
    name = recording.channels[column]
    low, high = (
        float(min(c.low[column] for c in cells)),
        float(max(c.high[column] for c in cells)),
    )
    rows = sum(len(e.values) for e in recording.episodes)
    count = int(sum(s.number[column] for s in steps))
    return ChannelNumbers(
        name,
        recording.units[column],
        name in recording.usual,
        low if low <= high else None,
        high if low <= high else None,
        float(sum(s.total[column] for s in steps)) / count if count else None,
        int(sum(s.still[column] for s in steps)) / max(count, 1),
        int(sum(c.unobserved[column] for c in cells)) / max(rows, 1),
        int(sum(c.nan[column] for c in cells)),
        int(sum(c.infinite[column] for c in cells)),
        recording.ranges.get(name),
        low < high and _two_valued(recording, column, (low, high)),
    )


def _two_valued(recording: Recording, column: int, extremes: tuple[float, float]) -> bool:
    """Tell whether a channel takes its extremes alone; most show by a few rows that they do not."""
    for rows in (slice(BLOCK), slice(None)):
        for episode in recording.episodes:
            values, observed = episode.values[rows, column], episode.observed[rows, column]
            if (observed & np.isfinite(values) & ~np.isin(values, extremes)).any():
                return False
    return True


def _cells(episode: Episode) -> _Cells:
    width = episode.values.shape[1]
    low, high = np.full(width, np.inf), np.full(width, -np.inf)
    unobserved, nan, infinite = (np.zeros(width, dtype=int) for _ in range(3))
    for values, observed in episode.blocks():
        known = observed & np.isfinite(values)
        if known.all():
            below = above = values
        else:
            below, above = np.where(known, values, np.inf), np.where(known, values, -np.inf)
            unobserved += (~observed).sum(axis=0)
            nan += (observed & np.isnan(values)).sum(axis=0)
            infinite += (observed & np.isinf(values)).sum(axis=0)
        low, high = np.minimum(low, below.min(axis=0)), np.maximum(high, above.max(axis=0))
    return _Cells(low, high, unobserved, nan, infinite)


def _steps(
    episode: Episode, limits: Float[ndarray, " D"], usual: list[int], *, whole: bool
) -> _Steps:
    """Return the steps of an episode; still are those up to `limits`."""
    width = episode.values.shape[1]
    total, count, still = np.zeros(width), np.zeros(width, dtype=int), np.zeros(width, dtype=int)
    together = 0
    for values, observed in episode.blocks(overlap=1):
        steps = np.abs(np.diff(values, axis=0))
        here = steps <= limits
        if whole:
            count += len(steps)
        else:
            known = observed & np.isfinite(values)
            both = known[1:] & known[:-1]
            count += both.sum(axis=0)
            # Where nothing is known nothing moves.
            steps, here = np.where(both, steps, 0.0), here | ~both
            still -= (~both).sum(axis=0)
        total += steps.sum(axis=0)
        still += here.sum(axis=0)
        together += int(here[:, usual].all(axis=1).sum())
    return _Steps(total, count, still, together / max(len(episode.values) - 1, 1))


def _jitter(times: list[Float[ndarray, " _"]], rate: float | None) -> float | None:
    intervals = np.concatenate([np.empty(0), *(np.diff(t) for t in times)])
    if rate is None or not len(intervals):
        return None
    near = intervals[intervals * rate < DROPPED]
    return float(np.abs(near * rate - 1).max()) if len(near) else None
