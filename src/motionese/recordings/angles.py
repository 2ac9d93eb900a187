"""Angles that wrap: at the end of a turn they leap to its beginning, which no joint does."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.errors import ChannelError
from motionese.recordings.choice import Choice, given_ranges, matching
from motionese.recordings.recording import Recording
from motionese.recordings.series import Series, series_of, with_columns

TURNS = (2 * np.pi, 360.0, 2.0**12, 2.0**14, 2.0**16)
"""A full turn [rad, deg, counts of encoders]."""
NEAR_END = 0.15
"""Share of a turn that a step across its end may at most differ from a whole one."""
BEYOND = 1.01
"""Turns within which the values of an angle lie that wraps."""


def turn_of(values: Sequence[Float[ndarray, " _"]], unit: str) -> float | None:
    """Return the full turn [unit] that the angles in these series wrap at, if they do.

    They wrap where they lie within one turn, and taking every step of more than half a turn the
    short way round leaves steps that are small beside it.
    """
    known = np.concatenate(values) if len(values) else np.empty(0)
    if not len(known):
        return None
    whole = bool((known == np.round(known)).all())
    width = float(known.max() - known.min())
    steps = np.concatenate([np.diff(v) for v in values])
    for turn in turns_in(unit):
        across = np.abs(steps) > turn / 2
        # Whole numbers are degrees, if they are angles at all.
        if not across.any() or width > BEYOND * turn or (whole and turn == TURNS[0]):
            continue
        if len(np.unique(known)) <= 2:
            continue
        left = np.abs(np.abs(steps[across]) - turn)
        others = np.abs(steps[~across])
        usual = float(np.quantile(others, 0.98)) if len(others) else 0.0
        if left.max() <= NEAR_END * turn and np.median(left) <= max(2 * usual, 0.02 * turn):
            return turn
    return None


def turns_in(unit: str) -> tuple[float, ...]:
    """Return the full turns that an angle may have in a unit; all where it is unknown."""
    by_unit = {"": TURNS, "rad": TURNS[:1], "radians": TURNS[:1]}
    by_unit |= dict.fromkeys(("deg", "°", "degree", "degrees"), TURNS[1:2])
    return by_unit.get(unit.strip().casefold(), ())


def wraps(values: Float[ndarray, " K"], turn: float) -> Int[ndarray, " W"]:
    """Return the steps at which an angle passes the end of a turn."""
    return np.flatnonzero(np.abs(np.diff(values)) > turn / 2)


def unwrapped(recording: Recording, choice: Choice) -> Recording:
    """Return a recording in which the angles that are to go on beyond the end of a turn do so.

    Every episode is moved by whole turns to begin beside the middle of the channel's range where
    that is given, or else beside where the first one begins.

    Raises:
        ChannelError: A channel that does not exist, or whose unit is none of an angle.
    """
    ranges, changed = given_ranges(recording, choice), {}
    for name in matching(recording, choice.unwrap, recording.channels):
        column = recording.channels.index(name)
        unit, series = recording.units[column], series_of(recording, column)
        if not (turns := turns_in(unit)):
            raise ChannelError(
                f"{recording.source}: channel '{name}' is in [{unit}], in which there are no turns "
                "to unwrap; --unwrap takes angles in rad or deg"
            )
        known = np.concatenate([s.values for s in series])
        width = float(np.ptp(known)) if len(known) else 0.0
        within = next((turn for turn in turns if width <= BEYOND * turn), turns[-1])
        turn = turn_of([s.values for s in series], unit) or within
        start = float(np.mean(ranges[name])) if name in ranges else None
        changed[column] = _continued(recording, column, series, turn, start)
    return with_columns(recording, changed)


def _continued(
    recording: Recording, column: int, series: Sequence[Series], turn: float, start: float | None
) -> list[Float[ndarray, " _"]]:
    result = []
    for episode, one in zip(recording.episodes, series, strict=True):
        values = episode.values[:, column].copy()
        if len(one.rows):
            whole = np.unwrap(one.values, period=turn)
            start = float(whole[0]) if start is None else start
            values[one.rows] = whole - turn * np.round((whole[0] - start) / turn)
        result.append(values)
    return result
