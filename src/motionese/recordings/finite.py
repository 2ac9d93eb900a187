"""Values that are no numbers: refused, or taken as gaps where the user says so."""

from dataclasses import replace

import numpy as np

from motionese.errors import MotionError
from motionese.recordings.recording import Recording

LARGEST = 1e100
"""Beyond this, squares and differences are no longer finite."""


def finite(recording: Recording, *, nan_is_gap: bool) -> Recording:
    """Return the recording with finite values wherever something was observed.

    Raises:
        MotionError: An infinite value, or a NaN that is no gap.
    """
    episodes = []
    for episode in recording.episodes:
        observed = episode.observed
        if nan_is_gap:
            observed = observed & ~np.isnan(episode.values)
        wrong = np.argwhere(observed & ~(np.abs(episode.values) <= LARGEST))
        if len(wrong):
            row, column = wrong[0]
            value = episode.values[row, column]
            raise MotionError(
                f"{recording.source}: episode '{episode.name}', row {row}, "
                f"channel '{recording.channels[column]}': values must be finite, got {value:g}"
                + ("; --nan gap takes NaN as not observed" if np.isnan(value) else "")
            )
        episodes.append(replace(episode, observed=observed))
    return replace(recording, episodes=tuple(episodes))
