"""Recordings for a trained model: its channels, in its order, at its rate."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy import ndarray

from motionese.arguments import refusing
from motionese.channels import Channels
from motionese.errors import ChannelError, RecordingError
from motionese.learning.fit import Fit
from motionese.learning.motions.motions import Motions
from motionese.learning.recognition.recognise import SAME_RATE
from motionese.recordings import (
    OPTIONS,
    Finding,
    Recording,
    choose,
    chosen,
    in_units,
    prepare,
    read,
)


@refusing()
def read_for(
    fit: Fit,
    path: str | Path,
    *,
    needed: Sequence[str] | None = None,
    format: str | None = None,
    **given: Any,
) -> Motions:
    """Read recordings as motions over a model's channels, in its order, with its ranges.

    A channel that is not needed may be missing; it is then not observed. Columns that are no
    channel of the model are left aside; those in another order are put into the model's.

    Args:
        fit: The model.
        path: The file or folder.
        needed: Channels that must be there; where left out, any one of the model's.
        format: As `Motions.read` takes it.
        given: What else `Motions.read` takes; ranges are the model's.

    Raises:
        ChannelError: A needed channel is missing, or all are.
        RecordingError: Another rate than the model's, or what `Motions.read` refuses.
    """
    channels = fit.network.channels
    assert channels is not None, "a trained network carries channels"
    told = {name: given.pop(name) for name in OPTIONS if name in given}
    wish = choose(**given)
    found = read(path, format, **told)
    taken = {"channels": wish.channels or found.channels, "exclude": wish.exclude}
    present = chosen(found, choose(**taken)).channels
    own = tuple(name for name in present if name in channels.names)
    missing = [name for name in needed or channels.names if name not in own]
    if missing and (needed is not None or not own):
        raise ChannelError(
            f"{path}: the model's channel '{missing[0]}' is missing; the model needs "
            f"{', '.join(needed or channels.names)}, here are {', '.join(own) or 'none of them'}"
        )
    order = tuple(name for name in channels.names if name in own)
    ranges = {c.name: (c.low, c.high) for c in channels if c.name in own}
    units = {c.name: c.unit for c in channels}
    found = found.found(*_compared(found, own, order, missing))
    found = in_units(chosen(found, choose(units=wish.units, channels=order)), units)
    found = found.found(*_far_out(found, ranges))
    own_way = {"channels": order, "exclude": (), "ranges": ranges, "units": None}
    ready = prepare(found, choose(**{**given, **own_way}))
    motions = Motions.from_recording(ready)
    if abs(motions.rate_hz - fit.rate_hz) > SAME_RATE * fit.rate_hz:
        raise RecordingError(
            f"{path}: {motions.rate_hz:g} rows a second, the model was trained at "
            f"{fit.rate_hz:g}; resample it to that (--resample {fit.rate_hz:g})"
        )
    return _widened(motions, channels)


def _far_out(recording: Recording, ranges: Mapping[str, tuple[float, float]]) -> list[Finding]:
    """Return what is told of channels of unknown units whose values are mostly beyond the model's.

    A range is widened by its own width on either side first.
    """
    findings = []
    for column, (name, unit) in enumerate(zip(recording.channels, recording.units, strict=True)):
        seen = np.concatenate([e.values[e.observed[:, column], column] for e in recording.episodes])
        low, high = ranges[name]
        far = (seen < 2 * low - high) | (seen > 2 * high - low)
        if not unit and len(seen) and far.mean() > 0.5:
            what = f"mostly far beyond the model's {low:.3g} to {high:.3g}: is it in another unit?"
            remedy = f"--unit {name}=UNIT tells in which"
            findings.append(Finding("unit", recording.source, what, remedy, channel=name))
    return findings


def _compared(
    found: Recording, own: Sequence[str], order: Sequence[str], missing: Sequence[str]
) -> list[Finding]:
    """Return what a recording's channels have to do with the model's."""
    findings = []
    if own != order:
        told = f"its channels are {', '.join(own)}; taken in the model's order {', '.join(order)}"
        findings.append(Finding("converted", found.source, told))
    if missing:
        count, told = len(missing), "a channel of the model, not in the recording; not looked at"
        findings.append(Finding("left out", found.source, told, channel=missing[0], count=count))
    return findings


def _widened(motions: Motions, channels: Channels) -> Motions:
    """Return the motions over all channels of the model, those that are missing not observed."""
    columns = channels.indices(motions.channels.names)

    def widened(part: ndarray) -> ndarray:
        whole = np.zeros((len(part), len(channels)), part.dtype)
        whole[:, columns] = part
        return whole

    values, masks = (list(map(widened, each)) for each in (motions.values, motions.observed))
    rate, names = motions.rate_hz, motions.names
    wide = Motions.from_arrays(values, channels, rate, observed=masks, names=names)
    return replace(wide, examined=motions.examined, held_out=motions.held_out)
