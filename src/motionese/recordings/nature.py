"""What a column is, whatever its name: a motion, or a clock, or a number of rows or episodes."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float, Int, Shaped
from numpy import ndarray

from motionese.recordings.finding import Finding
from motionese.recordings.recording import Recording

Column = Sequence[Float[ndarray, " _"]]
"""What one column holds in every episode."""

YEARS = (9.4e8, 2.6e9)
"""Seconds since 1970 that may be meant: from 1999 to 2052."""
CLOCKS = {1.0: "s", 1e-3: "ms", 1e-6: "µs", 1e-9: "ns"}
"""Units of clocks [s]."""
FEWEST = 10
"""Rows of most episodes by which a number of rows, or a clock that began with them, is known."""
FEWEST_RUNS = 3
"""Episodes by which their number is known."""
GLANCE = 12
"""Rows at the beginning that tell most motions from a clock."""
STEADY = 0.02
"""Share by which a step of an even clock may be off."""


@np.errstate(over="ignore", invalid="ignore")
def judged(recording: Recording) -> Recording:
    """Return the recording without clocks and numbers of rows among its usual channels."""
    findings = []
    whole = all(e.observed.all() for e in recording.episodes)
    for column, name in enumerate(recording.channels):
        unit = recording.units[column]
        if name in recording.usual and unit in {"", "sec", *CLOCKS.values()}:
            shown = _shown(recording, column, whole)
            if shown:
                what = f"{shown}, so it is not taken as a channel"
                remedy = f"--channels {name} … takes it"
                findings.append(Finding("column", recording.source, what, remedy, channel=name))
    usual = tuple(c for c in recording.usual if c not in {f.channel for f in findings})
    return replace(recording, usual=usual).found(*findings) if usual else recording


def since_1970(column: Column) -> float | None:
    """Return the unit [s] of a clock that counts from 1970; None for any other column."""
    for unit in CLOCKS:
        if all(_within(values * unit) and _rises(values) for values in _glances(column)):
            whole = [values for values in column if len(values)]
            if whole and all(_within(v * unit) and _rises(v) for v in whole):
                return unit
    return None


def beside(column: Column, times: Column) -> float | None:
    """Return the unit [s] of a clock that rises as `times` [s] do; None for any other column."""
    if not _long(column):
        return None
    return next((unit for unit in CLOCKS if _follows(column, times, unit)), None)


def counts_rows(column: Column) -> bool:
    """Tell whether a column of whole numbers rises by one from row to row in every episode."""
    if not _long(column):
        return False
    for rows in (_glances(column), column):
        if not all((v == np.round(v)).all() and (np.diff(v) == 1).all() for v in rows):
            return False
    return True


def rises_evenly(values: Float[ndarray, " T"]) -> bool:
    """Tell whether a column rises by the same from row to row, but where it begins again."""
    steps = np.diff(values)
    if len(values) < FEWEST or not np.isfinite(values).all() or not (usual := np.median(steps)) > 0:
        return False
    off = np.abs(steps - usual) > STEADY * usual
    return bool(off.mean() < 0.1)


def runs(values: Sequence[str] | Shaped[ndarray, " T"]) -> Int[ndarray, " R"]:
    """Return the rows at which a column changes, the first among them."""
    cells = np.asarray(values)
    return np.flatnonzero(np.append(True, cells[1:] != cells[:-1])[: len(cells)])


def counts_episodes(values: Float[ndarray, " T"]) -> bool:
    """Tell whether a column is a whole number for some rows, then the next, and so on."""
    for seen in (values[:GLANCE], values):
        steps = np.diff(seen)
        if not ((seen == np.round(seen)).all() and ((steps == 0) | (steps == 1)).all()):
            return False
    lengths = np.diff(np.append(runs(values), len(values)))
    return len(lengths) >= FEWEST_RUNS and bool((lengths > 1).all())


def _shown(recording: Recording, column: int, whole: bool) -> str:
    """Return in words what a channel is, if it is no motion; empty if it may be one."""
    seen = [slice(None) if whole else e.observed[:, column] for e in recording.episodes]
    values = [e.values[rows, column] for e, rows in zip(recording.episodes, seen, strict=True)]
    if counts_rows(values):
        return "rises by one from row to row"
    if unit := since_1970(values):
        return f"is a clock, counting {CLOCKS[unit]} since 1970"
    times = [e.times_at(recording.rate_hz) for e in recording.episodes]
    known = [t[rows] for t, rows in zip(times, seen, strict=True) if t is not None]
    if len(known) == len(values) and (unit := beside(values, known)):
        return f"is a clock, rising by the {CLOCKS[unit]} from row to row"
    return ""


def _long(column: Column) -> bool:
    return len(column) > 0 and float(np.median([len(values) for values in column])) >= FEWEST


def _glances(column: Column) -> Column:
    return [values[:GLANCE] for values in column[:1]]


def _within(seconds: Float[ndarray, " _"]) -> bool:
    return bool(((seconds > YEARS[0]) & (seconds < YEARS[1])).all())


def _rises(values: Float[ndarray, " _"]) -> bool:
    return bool((np.diff(values) >= 0).all() and (len(values) < 2 or values[-1] > values[0]))


def _follows(column: Column, times: Column, unit: float) -> bool:
    """Tell whether a column, in this unit, is never off `times` by more than a row."""
    for values, here in zip(column, times, strict=True):
        for rows in (slice(GLANCE), slice(None)):
            if len(here) > 1:
                usual = float(np.median(np.diff(here[rows])))
                off = (values[rows] - values[0]) * unit - (here[rows] - here[0])
                if not ((np.diff(values[rows]) > 0).all() and (np.abs(off) < usual).all()):
                    return False
    return True
