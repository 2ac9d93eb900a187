"""Where a file tells one rate and the times in it show another."""

from dataclasses import replace

import numpy as np

from motionese.recordings.finding import Finding
from motionese.recordings.rate import DIFFERS, rate_of_times
from motionese.recordings.recording import Episode, Recording


def as_timed(recording: Recording) -> Recording:
    """Return the recording with a finding where its times contradict the rate that is told.

    Where all episodes of two and more rows have such times, these count and no rate is told any
    more; else the rate of the others does.
    """
    told = recording.rate_hz
    timed = [e for e in recording.episodes if _rises(e)]
    shown = rate_of_times([e.times for e in timed if e.times is not None])
    if told is None or shown is None or abs(shown - told) <= DIFFERS * told:
        return recording
    everywhere = len(timed) == sum(len(e.values) > 1 for e in recording.episodes)
    found = Finding(
        "time",
        recording.source,
        f"the file tells {told:g} Hz, but the times show {shown:.4g} Hz: "
        + ("the times are taken" if everywhere else f"rows are put at {told:g} Hz by the times"),
        f"--resample {told:g} gives rows at the rate told" if everywhere else "",
        episode=timed[0].name,
        count=len(timed),
    )
    return replace(recording, rate_hz=None if everywhere else told).found(found)


def _rises(episode: Episode) -> bool:
    times = episode.times
    if times is None or len(times) < 2 or not np.isfinite(times).all():
        return False
    return bool((np.diff(times) > 0).all())
