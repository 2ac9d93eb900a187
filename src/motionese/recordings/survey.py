"""What is in a recording, in numbers, whatever is wrong with it: what a user looks at first."""

from dataclasses import replace
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.recordings.binary import two_values
from motionese.recordings.preparation import still_ends
from motionese.recordings.rate import DROPPED, rate_of_times
from motionese.recordings.recording import Episode, Recording

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


# What is absurd is shown, not refused: differences of huge values may overflow.
@np.errstate(over="ignore", invalid="ignore")
def survey(recording: Recording) -> Survey:
    """Return the numbers of a recording as it was read, before anything is refused or mended."""
    episodes = recording.episodes
    values, observed, seen, steps = (
        np.concatenate([of(e) for e in episodes]) if len(episodes) > 1 else of(episodes[0])
        for of in (attrgetter("values"), attrgetter("observed"), _seen, _steps)
    )
    low = values.min(axis=0, initial=np.inf, where=seen)
    high = values.max(axis=0, initial=-np.inf, where=seen)
    widths = np.where(low <= high, high, 0.0) - np.where(low <= high, low, 0.0)
    usual = [i for i, c in enumerate(recording.channels) if c in recording.usual]
    times = [e.times for e in episodes if e.times is not None]
    rising = [t for t in times if np.isfinite(t).all() and (np.diff(t) > 0).all()]
    rate = recording.rate_hz if recording.rate_hz is not None else rate_of_times(rising)
    return Survey(
        recording.source,
        rate,
        _jitter(rising, rate),
        tuple(_episode(e, widths, usual, rate) for e in episodes),
        tuple(
            _channel(recording, i, values[:, i], observed[:, i], steps[:, i], (low[i], high[i]))
            for i in range(len(recording.channels))
        ),
    )


def _episode(
    episode: Episode, widths: Float[ndarray, " D"], usual: list[int], rate: float | None
) -> EpisodeNumbers:
    rows, times = len(episode.values), episode.times
    shown = episode.part(columns=usual)
    shown = replace(shown, observed=_seen(shown))
    still = np.all(~(_steps(shown) > STILL_STEP * widths[usual]), axis=1)
    start, end = still_ends(shown, STILL_END * widths[usual]) if usual else (0, 0)
    duration = None if rate is None else max(rows - 1, 0) / rate
    if times is not None and rows:
        duration = float(times[-1] - times[0])
    return EpisodeNumbers(
        episode.name,
        rows,
        duration,
        start / max(rows, 1),
        end / max(rows, 1),
        _share(still),
        _share(~episode.observed),
        0 if times is None or rate is None else int((np.diff(times) * rate > DROPPED).sum()),
        int((episode.observed & np.isnan(episode.values)).sum()),
        int((episode.observed & np.isinf(episode.values)).sum()),
    )


def _channel(
    recording: Recording,
    column: int,
    values: Float[ndarray, " N"],
    observed: Bool[ndarray, " N"],
    steps: Float[ndarray, " _"],
    extremes: tuple[float, float],
) -> ChannelNumbers:
    name, (low, high) = recording.channels[column], map(float, extremes)
    steps = steps[~np.isnan(steps)]
    return ChannelNumbers(
        name,
        recording.units[column],
        name in recording.usual,
        low if low <= high else None,
        high if low <= high else None,
        float(steps.mean()) if len(steps) else None,
        _share(steps <= STILL_STEP * (high - low)),
        _share(~observed),
        int((observed & np.isnan(values)).sum()),
        int((observed & np.isinf(values)).sum()),
        recording.ranges.get(name),
        two_values([values[observed & np.isfinite(values)]]) is not None,
    )


def _seen(episode: Episode) -> Bool[ndarray, "T D"]:
    return np.asarray(episode.observed & np.isfinite(episode.values))


def _steps(episode: Episode) -> Float[ndarray, "_ D"]:
    """Return how far every value is from that of the row before; NaN where one is missing."""
    steps = np.diff(np.where(_seen(episode), episode.values, np.nan), axis=0)
    return np.asarray(np.abs(steps, out=steps))


def _jitter(times: list[Float[ndarray, " _"]], rate: float | None) -> float | None:
    intervals = np.concatenate([np.empty(0), *(np.diff(t) for t in times)])
    if rate is None or not len(intervals):
        return None
    near = intervals[intervals * rate < DROPPED]
    return float(np.abs(near * rate - 1).max()) if len(near) else None


def _share(which: Bool[ndarray, "*shape"]) -> float:
    return float(which.mean()) if which.size else 0.0
