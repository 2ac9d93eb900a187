"""Recordings of one file or folder, measured; and two of them, if they can be compared."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.analysis.statistics import FEWEST
from motionese.errors import ChannelError, SettingError
from motionese.interfaces.commands.shown_channels import Shown
from motionese.kinematics import MEASURES, Measures, measure


class Manner(NamedTuple):
    """How motions are measured: `still` [unit/s], `pause` and `window` [s], as `measure` does."""

    still: float | None
    pause: float
    window: float


@dataclass(frozen=True)
class Group:
    """What was read of one file or folder, and the measures of its episodes by name."""

    name: str
    shown: Shown
    measured: Mapping[str, Measures]

    def values(self, measure: str) -> Float[ndarray, " n"]:
        """Return one measure of all episodes; NaN where undefined."""
        return np.array([getattr(m, measure) for m in self.measured.values()], dtype=np.float64)

    def label(self, measure: str) -> str:
        """Return what a measure is called, with its unit."""
        unit = MEASURES[measure].unit.format(self.shown.unit or "unit")
        return MEASURES[measure].label + (f" [{unit}]" if unit else "")


def measured_group(shown: Shown, manner: Manner) -> Group:
    """Measure every episode of what was read."""
    source, rate_hz = shown.recording.source, shown.recording.rate_hz
    assert rate_hz is not None, "an even recording has a rate"
    measured = {
        episode.name: measure(
            episode.values,
            rate_hz,
            observed=episode.observed,
            still=manner.still,
            pause_s=manner.pause,
            window_s=manner.window,
        )
        for episode in shown.recording.episodes
    }
    return Group(source.name or str(source), shown, measured)


def comparable(groups: Sequence[Group]) -> list[Group]:
    """Return two groups, with names that tell them apart, if they can be compared.

    Raises:
        ChannelError: They are of different things.
        SettingError: One is too small.
    """
    one, other = (group.shown for group in groups)
    sizes = [len(shown.recording.channels) for shown in (one, other)]
    same = one.unit == other.unit
    if one.hand != other.hand or sizes[0] != sizes[1] or not same:
        raise ChannelError(
            f"{other.recording.source}: {other.what} cannot be compared with {one.what}"
        )
    for group in groups:
        if len(group.measured) < FEWEST:
            raise SettingError(
                f"{group.shown.recording.source}: holds 1 episode; a comparison needs at least "
                f"{FEWEST} on either side"
            )
    if groups[0].name != groups[1].name:
        return list(groups)
    return [replace(g, name=str(g.shown.recording.source)) for g in groups]
