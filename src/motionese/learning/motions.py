"""Motions: sequences of different lengths over named channels, with a mask of what was observed.

Nothing that pads a batch has a meaning: a padded or unobserved value enters neither the error nor
the network's input.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float
from numpy import ndarray

from motionese.channels import Channel, Channels
from motionese.errors import ChannelError, MotionError, unknown

MARGIN = 0.05
"""How far a range taken from data reaches beyond it, as a share of its width."""


class Batch(NamedTuple):
    """Motions as the network takes them, padded to one length.

    Attributes:
        sensed: Values in the unit interval; 0.5 where nothing was observed.
        observed: 1 where a value was observed, 0 where not or where a motion has ended.
    """

    sensed: Float[Array, "S T D"]
    observed: Float[Array, "S T D"]


@dataclass(frozen=True)
class Motions:
    """Sequences over the same channels at the same rate.

    Attributes:
        values: One array [T_i, D] per motion, in the channels' units.
        observed: One array [T_i, D] per motion: what was observed.
        channels: Names, units and ranges of the D columns.
        rate_hz: Rows per second [Hz].
        names: One name per motion.
    """

    values: tuple[Float[ndarray, "_ D"], ...]
    observed: tuple[Bool[ndarray, "_ D"], ...]
    channels: Channels
    rate_hz: float
    names: tuple[str, ...]

    @classmethod
    def from_arrays(
        cls,
        arrays: Sequence[Any],
        channels: Channels | Sequence[str],
        rate_hz: float,
        *,
        observed: Sequence[Any] | None = None,
        units: Mapping[str, str] | None = None,
        ranges: Mapping[str, tuple[float, float]] | None = None,
        names: Sequence[str] | None = None,
    ) -> "Motions":
        """Make motions of arrays [T_i, D] and check them.

        Args:
            arrays: One array per motion, in the channels' units.
            channels: The channels themselves, or their names.
            rate_hz: Rows per second [Hz].
            observed: One mask [T_i, D] per motion; everything is observed if left out. What is
                not observed may be anything, NaN included.
            units: Units by channel name; empty where left out. For channels given by name.
            ranges: Ranges (low, high) by channel name; from the data with a margin where left
                out. For channels given by name.
            names: One name per motion; numbered where left out.

        Raises:
            MotionError: No motions; a motion of fewer than two rows, of another width, or with a
                value that is observed and not finite.
            ChannelError: A channel that never changes and has no range given, or a unit or range
                of a channel that is not there.
        """
        if not arrays:
            raise MotionError("no motions given; at least one is needed")
        if not (np.isfinite(rate_hz) and rate_hz > 0):
            raise MotionError(f"rate_hz must be finite and > 0, got {rate_hz}")
        called = tuple(names) if names is not None else tuple(str(i) for i in range(len(arrays)))
        values = [np.array(a, dtype=np.float64) for a in arrays]
        masks = (
            [np.ones(v.shape, dtype=bool) for v in values]
            if observed is None
            else [np.array(m, dtype=bool) for m in observed]
        )
        labels = channels.names if isinstance(channels, Channels) else tuple(channels)
        if not len(values) == len(masks) == len(called):
            raise MotionError(
                f"{len(values)} motions need as many masks and names, "
                f"got {len(masks)} and {len(called)}"
            )
        for name, value, mask in zip(called, values, masks, strict=True):
            _check(name, value, mask, labels)
        if not isinstance(channels, Channels):
            channels = _channels_of(values, masks, labels, units or {}, ranges or {})
        return cls(tuple(values), tuple(masks), channels, float(rate_hz), called)

    @property
    def lengths(self) -> tuple[int, ...]:
        """Rows of every motion."""
        return tuple(len(v) for v in self.values)

    def showing(self, channels: Sequence[str]) -> "Motions":
        """Return the same motions with only the named channels observed."""
        seen = np.zeros(len(self.channels), dtype=bool)
        seen[self.channels.indices(channels)] = True
        masks = tuple(mask & seen for mask in self.observed)
        return Motions(self.values, masks, self.channels, self.rate_hz, self.names)

    def scaled_by(self, channels: Channels) -> "Motions":
        """Return the same values, to be mapped to the unit interval by other channels."""
        return Motions(self.values, self.observed, channels, self.rate_hz, self.names)

    def batch(self, length: int | None = None, capacity: int | None = None) -> Batch:
        """Return the motions padded to one length.

        Args:
            length: Rows to pad to; the longest motion's where left out.
            capacity: Motions to pad to with empty ones, so that batches of different numbers run
                through the same compiled code; no padding where left out.

        Raises:
            MotionError: The motions do not fit into so many rows or motions.
        """
        rows, count = length or max(self.lengths), capacity or len(self)
        if rows < max(self.lengths) or count < len(self):
            raise MotionError(
                f"{len(self)} motions of up to {max(self.lengths)} rows "
                f"do not fit into {count} of {rows} rows"
            )
        sensed = np.full((count, rows, len(self.channels)), 0.5)
        observed = np.zeros(sensed.shape)
        for i, (value, mask) in enumerate(zip(self.values, self.observed, strict=True)):
            scaled = self.channels.to_unit(np.where(mask, value, 0.0))
            sensed[i, : len(value)] = np.where(mask, scaled, 0.5)
            observed[i, : len(value)] = mask
        return Batch(jnp.asarray(sensed, jnp.result_type(float)), jnp.asarray(observed, float))

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, index: int) -> "Motions":
        """Return one motion as Motions."""
        return Motions(
            (self.values[index],),
            (self.observed[index],),
            self.channels,
            self.rate_hz,
            (self.names[index],),
        )

    def __iter__(self) -> Iterator["Motions"]:
        return (self[i] for i in range(len(self)))


def _check(name: str, value: ndarray, mask: ndarray, labels: Sequence[str]) -> None:
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


def _channels_of(
    values: Sequence[ndarray],
    masks: Sequence[ndarray],
    labels: Sequence[str],
    units: Mapping[str, str],
    ranges: Mapping[str, tuple[float, float]],
) -> Channels:
    for name in (*units, *ranges):
        if name not in labels:
            raise ChannelError(unknown("channel", name, labels))
    channels = []
    for column, name in enumerate(labels):
        if name in ranges:
            low, high = ranges[name]
        else:
            seen = np.concatenate(
                [v[m[:, column], column] for v, m in zip(values, masks, strict=True)]
            )
            if not len(seen) or seen.min() == seen.max():
                what = f"is always {seen[0]:g}" if len(seen) else "is never observed"
                raise ChannelError(f"channel '{name}' {what}: give its range or leave it out")
            margin = MARGIN * (seen.max() - seen.min())
            low, high = float(seen.min() - margin), float(seen.max() + margin)
        channels.append(Channel(name, units.get(name, ""), low, high))
    return Channels(channels)
