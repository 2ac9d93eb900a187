"""What a file of recordings holds, before anything is chosen, filled in, or refused."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.recordings.finding import Finding

LARGEST = 1e100
"""Beyond this, squares and differences are no longer finite."""
BLOCK = 512
"""Rows that are looked at together, few enough to stay near the processor."""


@dataclass(frozen=True)
class Episode:
    """One motion as it was recorded.

    Attributes:
        name: Unique in its recording.
        times: Of the rows [s]; None where they are evenly spaced at the recording's rate.
        values: In the channels' units; anything where nothing was observed.
        observed: False only where the file says that nothing was recorded: an empty cell, no
            message of that topic, a mask. A NaN that was written as a value counts as observed.
    """

    name: str
    times: Float[ndarray, " T"] | None
    values: Float[ndarray, "T D"]
    observed: Bool[ndarray, "T D"]

    @classmethod
    def whole(
        cls, name: str, values: Float[ndarray, "T D"], times: Float[ndarray, " T"] | None = None
    ) -> "Episode":
        """Return an episode of which everything was observed."""
        return cls(name, times, values, np.ones(values.shape, dtype=bool))

    def part(
        self, rows: slice = slice(None), columns: slice | list[int] = slice(None)
    ) -> "Episode":
        """Return some rows of an evenly spaced episode, or some columns of any."""
        # Columns side by side need no copy.
        if isinstance(columns, list) and columns[:1] + [c + 1 for c in columns[:-1]] == columns:
            columns = slice(columns[0], columns[-1] + 1) if columns else slice(0)
        values, observed = self.values[rows, columns], self.observed[rows, columns]
        return replace(self, values=values, observed=observed)

    def blocks(
        self, overlap: int = 0
    ) -> Iterator[tuple[Float[ndarray, "B D"], Bool[ndarray, "B D"]]]:
        """Yield values and what was observed, some rows at a time, and `overlap` of those after."""
        for start in range(0, len(self.values) - overlap, BLOCK):
            rows = slice(start, start + BLOCK + overlap)
            yield self.values[rows], self.observed[rows]

    @property
    def known(self) -> Bool[ndarray, "T D"]:
        """Where something was observed that can be computed with."""
        return np.asarray(self.observed & (np.abs(self.values) <= LARGEST))

    def times_at(self, rate_hz: float | None) -> Float[ndarray, " T"] | None:
        """Return the rows' times [s]; where it has none, those of a rate; None without either."""
        if self.times is None and rate_hz is not None:
            return np.arange(len(self.values)) / rate_hz
        return self.times


@dataclass(frozen=True)
class Recording:
    """Episodes over the same channels, as one file or folder holds them.

    Attributes:
        source: The file or folder, for messages.
        channels: Names of the D columns.
        units: One per channel; empty where unknown.
        ranges: (low, high) in the channel's unit, of those channels whose range the file tells.
        rate_hz: Rows per second [Hz] that the file tells; None where only times tell it, or
            nothing does.
        episodes: At least one.
        usual: The channels that are taken when none are chosen.
        binary: The two values of channels that are to be held at them when they are generated.
        held_out: Names of episodes that the file sets apart for testing.
        findings: What was found or done while it was read, and since.
    """

    source: Path
    channels: tuple[str, ...]
    units: tuple[str, ...]
    ranges: Mapping[str, tuple[float, float]]
    rate_hz: float | None
    episodes: tuple[Episode, ...]
    usual: tuple[str, ...]
    binary: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    held_out: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()

    def map(self, change: Callable[[Episode], Episode]) -> "Recording":
        """Return the recording with every episode changed."""
        return replace(self, episodes=tuple(map(change, self.episodes)))

    def found(self, *findings: Finding) -> "Recording":
        """Return the recording with further findings."""
        return replace(self, findings=(*self.findings, *findings))

    def first(self, which: Callable[[Episode], Bool[ndarray, "T D"]]) -> tuple[str, float] | None:
        """Return in words where the first of certain cells is, and its value."""
        for episode in self.episodes:
            here = which(episode)
            for row, column in np.argwhere(here) if here.any() else ():
                where = f"episode '{episode.name}', row {row}, channel '{self.channels[column]}'"
                return where, float(episode.values[row, column])
        return None
