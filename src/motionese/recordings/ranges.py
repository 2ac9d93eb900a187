"""The range of a channel, taken from what was observed of it."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import ChannelError
from motionese.recordings.channels import matching
from motionese.recordings.choice import Choice
from motionese.recordings.recording import Recording


def range_of(name: str, seen: Float[ndarray, " K"], margin: float) -> tuple[float, float]:
    """Return the lowest and highest value, widened on both sides by a share of their distance.

    Raises:
        ChannelError: Nothing was observed, or it is always the same.
    """
    if not len(seen) or seen.min() == seen.max():
        what = f"is always {seen[0]:g}" if len(seen) else "is never observed"
        raise ChannelError(f"channel '{name}' {what}: give its range or leave it out")
    low, high = float(seen.min()), float(seen.max())
    return low - margin * (high - low), high + margin * (high - low)


def all_ranges(recording: Recording, choice: Choice) -> Mapping[str, tuple[float, float]]:
    """Return the range of every channel: given by the user, told by the file, or of the data.

    Raises:
        ChannelError: A range for no channel, or a channel that has none and never changes.
    """
    ranges = dict(recording.ranges)
    for pattern, limits in choice.ranges.items():
        ranges |= dict.fromkeys(matching(recording, pattern, recording.channels), limits)
    for column, name in enumerate(recording.channels):
        if name not in ranges:
            seen = [e.values[e.observed[:, column], column] for e in recording.episodes]
            try:
                ranges[name] = range_of(name, np.concatenate(seen), choice.margin)
            except ChannelError as error:
                raise ChannelError(
                    f"{recording.source}: {error} (--range {name}=LOW:HIGH, --exclude {name})"
                ) from error
    return {name: ranges[name] for name in recording.channels}
