"""Recordings for a trained model: its channels, in its order, at its rate."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from motionese.channels import Channels
from motionese.errors import ChannelError, RecordingError
from motionese.learning.fit import Fit
from motionese.learning.motions.motions import Motions
from motionese.learning.recognition.recognise import SAME_RATE
from motionese.recordings import choose, chosen, prepare, read


def read_for(
    fit: Fit,
    path: str | Path,
    *,
    needed: Sequence[str] | None = None,
    format: str | None = None,
    episode: str | None = None,
    time: str | None = None,
    **choice: Any,
) -> Motions:
    """Read recordings as motions over a model's channels, in its order, with its ranges.

    A channel that is not needed may be missing; it is then not observed. Columns that are no
    channel of the model are left aside.

    Args:
        fit: The model.
        path: The file or folder.
        needed: Channels that must be there; all where left out.
        format: As `Motions.read` takes it.
        episode: As `Motions.read` takes it.
        time: As `Motions.read` takes it.
        choice: What else `Motions.read` takes; ranges are the model's.

    Raises:
        ChannelError: A needed channel is missing, or they stand in another order.
        RecordingError: Another rate than the model's, or what `Motions.read` refuses.
    """
    channels = fit.network.channels
    assert channels is not None, "a trained network carries channels"
    wish = choose(**choice)
    found = read(path, format, episode=episode, time=time)
    taken = {"channels": wish.channels or found.channels, "exclude": wish.exclude}
    present = chosen(found, choose(**taken)).channels
    own = tuple(name for name in present if name in channels.names)
    _check_channels(path, channels, own, channels.names if needed is None else needed)
    ranges = {c.name: (c.low, c.high) for c in channels if c.name in own}
    ready = prepare(found, choose(**{**choice, "channels": own, "exclude": (), "ranges": ranges}))
    motions = Motions.from_recording(ready)
    if abs(motions.rate_hz - fit.rate_hz) > SAME_RATE * fit.rate_hz:
        raise RecordingError(
            f"{path}: {motions.rate_hz:g} rows a second, the model was trained at "
            f"{fit.rate_hz:g}; resample it to that (--resample {fit.rate_hz:g})"
        )
    return _widened(motions, channels)


def _check_channels(
    path: str | Path, channels: Channels, present: Sequence[str], needed: Sequence[str]
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
