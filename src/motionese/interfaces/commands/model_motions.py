"""Recordings for a trained model: its channels, in its order, at its rate."""

from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import numpy as np

from motionese.channels import Channels
from motionese.errors import ChannelError, RecordingError, unknown
from motionese.learning import Fit, Motions
from motionese.learning.recognition.recognise import SAME_RATE
from motionese.recordings import choose, chosen, prepare, read


def read_for(
    fit: Fit,
    path: Path,
    *,
    columns: Mapping[str, str | None],
    choice: Mapping[str, Any],
    needed: Sequence[str],
) -> Motions:
    """Read recordings as motions over a model's channels.

    A channel that is not needed may be missing; it is then not observed. Columns that are no
    channel of the model are left aside.

    Args:
        fit: The model.
        path: The file or folder.
        columns: Format, episode and time column, as `recordings.read` takes them.
        choice: What else `Motions.read` takes.
        needed: Channels that must be there.

    Raises:
        ChannelError: A needed channel is missing, or they stand in another order.
        RecordingError: Another rate than the model's.
    """
    assert fit.network.channels is not None, "a trained network carries channels"
    channels = fit.network.channels
    found = read(path, columns["format"], episode=columns["episode"], time=columns["time"])
    named = choice["channels"] is not None
    present = chosen(
        found,
        choose(channels=choice["channels"] if named else found.channels, exclude=choice["exclude"]),
    ).channels
    own = tuple(name for name in present if name in channels.names)
    _check_channels(path, channels, own, needed)
    ranges = {c.name: (c.low, c.high) for c in channels if c.name in own}
    wanted = choose(**{**choice, "channels": own, "exclude": (), "ranges": ranges})
    motions = Motions.from_recording(prepare(found, wanted))
    if abs(motions.rate_hz - fit.rate_hz) > SAME_RATE * fit.rate_hz:
        raise RecordingError(
            f"{path}: {motions.rate_hz:g} rows a second, the model was trained at "
            f"{fit.rate_hz:g}; resample it: --resample {fit.rate_hz:g}"
        )
    return _widened(motions, channels)


def names_matching(channels: Channels, patterns: Sequence[str]) -> list[str]:
    """Return the model's channels of these names or patterns, in the model's order."""
    taken: set[str] = set()
    for pattern in patterns:
        fitting = {n for n in channels.names if n == pattern or fnmatchcase(n, pattern)}
        if not fitting:
            raise ChannelError(unknown("channel", pattern, channels.names))
        taken |= fitting
    return [name for name in channels.names if name in taken]


def _check_channels(
    path: Path, channels: Channels, present: Sequence[str], needed: Sequence[str]
) -> None:
    missing = [name for name in needed if name not in present]
    if missing:
        raise ChannelError(
            f"{path}: the model's channel '{missing[0]}' is missing; "
            f"the model needs {', '.join(needed)}, here are {', '.join(present) or 'none of them'}"
        )
    order = [name for name in channels.names if name in present]
    if list(present) != order:
        raise ChannelError(
            f"{path}: its channels stand in another order than the model's: "
            f"{', '.join(present)}; name them in the model's: --channels {','.join(order)}"
        )


def _widened(motions: Motions, channels: Channels) -> Motions:
    """Return the motions over all channels of the model, those that are missing not observed."""
    columns = channels.indices(motions.channels.names)
    values, masks = [], []
    for value, mask in zip(motions.values, motions.observed, strict=True):
        whole = np.zeros((len(value), len(channels)))
        seen = np.zeros(whole.shape, dtype=bool)
        whole[:, columns], seen[:, columns] = value, mask
        values.append(whole)
        masks.append(seen)
    return Motions.from_arrays(
        values, channels, motions.rate_hz, observed=masks, names=motions.names
    )
