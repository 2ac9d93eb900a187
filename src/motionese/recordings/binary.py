"""Channels of two values, such as a gripper: which they are, and rows held at them."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import ChannelError
from motionese.recordings.choice import Choice, matching
from motionese.recordings.recording import Recording
from motionese.recordings.series import series_of, with_columns


def two_values(values: Sequence[Float[ndarray, " _"]]) -> tuple[float, float] | None:
    """Return the two values that series take, if they take two; the lower first."""
    known = np.unique(np.concatenate(list(values))) if len(values) else np.empty(0)
    return (float(known[0]), float(known[1])) if len(known) == 2 else None


def with_binary(recording: Recording, choice: Choice) -> Recording:
    """Return a recording that tells the two values of the channels chosen to be binary.

    `ChannelError` where a channel does not exist or takes more or fewer values than two.
    """
    binary = dict(recording.binary)
    for name in matching(recording, choice.binary, recording.channels):
        series = [s.values for s in series_of(recording, recording.channels.index(name))]
        found = two_values(series)
        if found is None:
            count = len(np.unique(np.concatenate(series)))
            raise ChannelError(
                f"{recording.source}: channel '{name}' takes {count} values; "
                "--binary names channels of two"
            )
        binary[name] = found
    return replace(recording, binary=binary)


def held(recording: Recording) -> Recording:
    """Return a recording whose binary channels are at the nearer of their two values."""
    changed = {}
    for name, (low, high) in recording.binary.items():
        column = recording.channels.index(name)
        middle = (low + high) / 2
        changed[column] = [
            np.where(e.values[:, column] > middle, high, low) for e in recording.episodes
        ]
    return with_columns(recording, changed)
