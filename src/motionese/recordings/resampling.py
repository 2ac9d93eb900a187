"""Another rate: averaged over one new interval before going down, then interpolated."""

from dataclasses import replace

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import SettingError
from motionese.recordings.recording import Episode, Recording

LARGEST = 100
"""Largest factor by which a rate can be raised."""


def resampled(recording: Recording, rate_hz: float) -> Recording:
    """Return an evenly spaced recording at another rate [Hz].

    Going down, every channel is averaged first, over a window of one new interval around each
    row, so that nothing faster folds into the new rate and nothing is delayed. A new row is
    observed where both rows around it were.

    Raises:
        SettingError: The rate would be raised more than a hundredfold.
    """
    assert recording.rate_hz is not None
    step = recording.rate_hz / rate_hz
    if abs(step - 1) < 1e-9:
        return recording
    if step * LARGEST < 1:
        raise SettingError(
            f"{recording.source}: recorded at {recording.rate_hz:g} Hz, it cannot be "
            f"resampled to {rate_hz:g} Hz, more than {LARGEST} times as much"
        )
    episodes = tuple(_resampled(e, step) if len(e.values) else e for e in recording.episodes)
    return replace(recording, rate_hz=rate_hz, episodes=episodes)


def _resampled(episode: Episode, step: float) -> Episode:
    values = np.where(episode.observed, episode.values, 0.0)
    if step > 1:
        for column, seen in enumerate(episode.observed.T):
            edges = np.flatnonzero(np.diff(np.concatenate([[False], seen, [False]])))
            for start, end in edges.reshape(-1, 2):
                values[start:end, column] = _averaged(values[start:end, column], step)
    # A tiny bit beyond the last row is that row, or rounding would cost it.
    at = np.arange(int((len(values) - 1) / step + 1e-9) + 1) * step
    before = np.minimum((at + 1e-9).astype(int), len(values) - 1)
    share = np.clip(at - before, 0.0, None)[:, None]
    share[share < 1e-9] = 0.0
    after = np.minimum(before + 1, len(values) - 1)
    return replace(
        episode,
        values=(1 - share) * values[before] + share * values[after],
        observed=episode.observed[before] & (episode.observed[after] | (share == 0)),
    )


def _averaged(run: Float[ndarray, " R"], width: float) -> Float[ndarray, " R"]:
    """Return the mean over `width` rows around every row of a run without gaps.

    Beyond its ends the run is turned about its end points, so that a straight line stays one.
    """
    reach = min(int(np.ceil((width - 1) / 2)), len(run) - 1)
    offsets = np.arange(-reach, reach + 1)
    weights = np.clip(width / 2 + 0.5 - np.abs(offsets), 0.0, 1.0)
    padded = np.pad(run, reach, mode="reflect", reflect_type="odd")
    return np.asarray(np.convolve(padded, weights / weights.sum(), mode="valid"))
