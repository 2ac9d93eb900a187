"""Formats that hold neither times nor masks: what fits into them, and what does not."""

from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import RecordingError
from motionese.recordings.even import JITTER
from motionese.recordings.recording import Recording


def times_unless_even(
    times: Float[ndarray, " T"], rate_hz: float | None
) -> Float[ndarray, " T"] | None:
    """Return `times` [s] counted from the first, or None where they only repeat the rate."""
    since_first: Float[ndarray, " T"] = times - times[:1]
    if rate_hz is not None:
        off = since_first * rate_hz - np.arange(len(times))
        if np.all(np.abs(off) <= JITTER):
            return None
    return since_first


def check_even_and_whole(path: Path, recording: Recording, what: str) -> None:
    """Refuse what a format of evenly spaced rows without masks cannot hold.

    Args:
        path: The file or folder that is to be written.
        recording: What is to be written.
        what: The format, for the sentence.

    Raises:
        RecordingError: An episode is empty, has gaps, or is not evenly spaced at the rate.
    """
    for episode in recording.episodes:
        where = f"{path}: episode '{episode.name}'"
        if not len(episode.values):
            raise RecordingError(f"{where} has no rows; {what} needs at least one")
        gaps = np.argwhere(~(episode.observed & np.isfinite(episode.values)))
        if len(gaps):
            row, column = gaps[0]
            raise RecordingError(
                f"{where}, row {row}, channel '{recording.channels[column]}': nothing observed, "
                f"and {what} cannot hold gaps; csv, npz and mcap can"
            )
        times, rate = episode.times, recording.rate_hz
        if times is not None and times_unless_even(times, rate) is not None:
            at = "at a known rate" if rate is None else f"at {rate:g} Hz"
            raise RecordingError(
                f"{where} is not evenly spaced {at}, and {what} holds no uneven times: "
                f"resample it first"
            )
