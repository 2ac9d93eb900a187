"""Where a log is cut into takes: at silences, and where a topic says that one begins or ends."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from jaxtyping import Int
from numpy import ndarray

from motionese.errors import SettingError
from motionese.recordings.finding import Finding
from motionese.recordings.formats.conventions import numbered
from motionese.recordings.recording import Episode


class Mark(NamedTuple):
    """A message on the topic that marks takes.

    Attributes:
        time: When it was recorded [ns].
        begins: Whether a take begins, or one ends.
        name: Of the take; empty where it is not told.
    """

    time: int
    begins: bool
    name: str

    @classmethod
    def of(cls, time: int, value: Any) -> "Mark":
        """Return what a message means: false ends a take, text names it, all else begins one."""
        said = value.get("data") if isinstance(value, dict) else getattr(value, "data", value)
        name = " ".join(said.split()) if isinstance(said, str) else ""
        return cls(time, said is not False, name)


@dataclass(frozen=True)
class Cuts:
    """How a log is cut: at silences longer than `pause` [s], and by the topic `marker`."""

    pause: float | None = None
    marker: str | None = None

    def __post_init__(self) -> None:
        if self.pause is not None and not (np.isfinite(self.pause) and self.pause > 0):
            raise SettingError(f"--pause is a time > 0 [s], got {self.pause:g}")

    def takes(
        self, source: Path, name: str, times: Int[ndarray, " T"], marks: Sequence[Mark]
    ) -> tuple[list[tuple[str, slice]], list[Finding]]:
        """Return name and rows of every take in rows at these times [ns], and what is left out."""
        parts, findings = [(name, slice(0, len(times)))], []
        if self.marker is not None:
            parts = _marked(name, times, sorted(marks))
            outside = len(times) - sum(part.stop - part.start for _, part in parts)
            if outside:
                what = f"{outside} of {len(times)} rows are in no take that {self.marker} marks"
                findings.append(Finding("left out", source, f"{what}; they are left out"))
        if self.pause is not None:
            silent = np.flatnonzero(np.diff(times) > self.pause * 1e9) + 1
            parts = [piece for part in parts for piece in _pieces(*part, silent)]
        return parts, findings

    def named(self, episodes: Sequence[Episode]) -> tuple[Episode, ...]:
        """Return the takes with those that share a name numbered, such as reach_0, reach_1."""
        if self.marker is None:
            return tuple(episodes)
        count, met = Counter(e.name for e in episodes), Counter[str]()
        apart = []
        for episode in episodes:
            number = f"_{met[episode.name]}" if count[episode.name] > 1 else ""
            apart.append(replace(episode, name=episode.name + number))
            met[episode.name] += 1
        return tuple(apart)


def _marked(name: str, times: Int[ndarray, " T"], marks: list[Mark]) -> list[tuple[str, slice]]:
    rows = [*np.searchsorted(times, [mark.time for mark in marks]).tolist(), len(times)]
    spans = zip(marks, rows, rows[1:], strict=False)
    return [(mark.name or name, slice(a, b)) for mark, a, b in spans if mark.begins and a < b]


def _pieces(name: str, part: slice, cuts: Int[ndarray, " _"]) -> list[tuple[str, slice]]:
    inside = cuts[(cuts > part.start) & (cuts < part.stop)].tolist()
    ends = [part.start, *inside, part.stop]
    names = numbered(name, len(ends) - 1)
    return [(n, slice(a, b)) for n, a, b in zip(names, ends, ends[1:], strict=False)]
