"""Arrays that are to be motions: refused where they cannot be, and channels made to fit them."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy import ndarray

from motionese.arguments import numbers
from motionese.channels import Channel, Channels
from motionese.errors import ChannelError, MotionError, unknown
from motionese.recordings import MARGIN, range_of


def checked(
    arrays: Sequence[Any] | ndarray,
    observed: Sequence[Any] | None,
    names: Sequence[str] | None,
    labels: Sequence[str],
) -> tuple[tuple[ndarray, ...], tuple[ndarray, ...], tuple[str, ...]]:
    """Return values, masks and names of motions over the channels `labels`, copied and checked.

    Raises:
        MotionError: No motions, or one that cannot be learned from.
    """
    if not len(arrays):
        raise MotionError("no motions given; at least one is needed")
    called = tuple(names) if names is not None else tuple(str(i) for i in range(len(arrays)))
    values = tuple(numbers("a motion", a, MotionError) for a in arrays)
    if observed is None:
        observed = [np.ones(v.shape, dtype=bool) for v in values]
    masks = tuple(numbers("a mask", m, MotionError).astype(bool) for m in observed)
    if not len(values) == len(masks) == len(called):
        raise MotionError(
            f"{len(values)} motions need as many masks and names, "
            f"got {len(masks)} and {len(called)}"
        )
    for name, value, mask in zip(called, values, masks, strict=True):
        if value.ndim != 2 or value.shape[1] != len(labels):
            raise MotionError(
                f"motion '{name}': expected an array [T, {len(labels)}] for the channels "
                f"{', '.join(labels)}, got shape {value.shape}"
            )
        if mask.shape != value.shape:
            raise MotionError(
                f"motion '{name}': its mask has shape {mask.shape}, its values {value.shape}"
            )
        if len(value) < 2:
            raise MotionError(f"motion '{name}': at least 2 rows are needed, got {len(value)}")
        wrong = np.argwhere(mask & ~np.isfinite(value))
        if len(wrong):
            row, column = wrong[0]
            raise MotionError(
                f"motion '{name}', row {row}, channel '{labels[column]}': "
                f"values must be finite, got {value[row, column]}; mask what was not observed"
            )
    return values, masks, called


def checked_weights(
    weights: Sequence[Any], values: Sequence[ndarray], names: Sequence[str]
) -> tuple[ndarray, ...]:
    """Return the weights of motions' values, copied; `MotionError` where they cannot be."""
    counts = tuple(numbers("weights", w, MotionError) for w in weights)
    if len(counts) != len(values):
        raise MotionError(f"{len(values)} motions need as many weights, got {len(counts)}")
    for name, count, value in zip(names, counts, values, strict=True):
        if count.shape != value.shape:
            raise MotionError(
                f"motion '{name}': its weights have shape {count.shape}, its values {value.shape}"
            )
        if not (np.isfinite(count).all() and count.min() >= 0):
            raise MotionError(f"motion '{name}': weights must be finite and ≥ 0")
    return counts


def channels_of(
    values: Sequence[ndarray],
    masks: Sequence[ndarray],
    labels: Sequence[str],
    units: Mapping[str, str],
    ranges: Mapping[str, tuple[float, float]],
) -> Channels:
    """Return channels of these names, with ranges from the data where none are given.

    Raises:
        ChannelError: A unit or range of a channel that is not there, or a channel without a
            range that never changes.
    """
    for name in (*units, *ranges):
        if name not in labels:
            raise ChannelError(unknown("channel", name, labels))
    channels = []
    for column, name in enumerate(labels):
        if name in ranges:
            low, high = ranges[name]
        else:
            seen = [v[m[:, column], column] for v, m in zip(values, masks, strict=True)]
            low, high = range_of(name, np.concatenate(seen), MARGIN)
        channels.append(Channel(name, units.get(name, ""), low, high))
    return Channels(channels)
