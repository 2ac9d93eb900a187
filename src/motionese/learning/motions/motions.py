"""Motions: sequences of different lengths over named channels, with a mask of what was observed.

Nothing that pads a batch has a meaning: a padded or unobserved value enters neither the error nor
the network's input. What was observed and how much it counts are two things: `observed` gates the
input, `weights` weigh the error.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import jax.numpy as jnp
import numpy as np
from jaxtyping import Bool, Float
from numpy import ndarray

from motionese.arguments import refusing, several
from motionese.channels import Channels
from motionese.errors import ChannelError, MotionError, RecordingError, unknown
from motionese.learning.motions.arrays import channels_of, checked, checked_weights
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.stored import StoredArrays
from motionese.recordings import (
    OPTIONS,
    Episode,
    Finding,
    Recording,
    choose,
    prepare,
    prepare_stored,
    read_stored,
)
from motionese.recordings import read as read_recording
from motionese.recordings import write as write_recording


@dataclass(frozen=True)
class Motions:
    """Sequences over the same channels at the same rate.

    Attributes:
        values: One array [T_i, D] per motion, in the channels' units; of `StoredArrays` each is
            read when it is asked for, and kept nowhere.
        observed: One array [T_i, D] per motion: what was observed.
        channels: Names, units and ranges of the D columns.
        rate_hz: Rows per second [Hz].
        names: One name per motion.
        weights: One array [T_i, D] per motion: how much each value counts in the error; None
            where all that was observed counts alike.
        examined: What was found in the recording they are from, or done to it.
        held_out: Names of the motions that the recording sets apart for testing.
    """

    values: tuple[Float[ndarray, "_ D"], ...] | StoredArrays
    observed: tuple[Bool[ndarray, "_ D"], ...] | StoredArrays
    channels: Channels
    rate_hz: float
    names: tuple[str, ...]
    weights: tuple[Float[ndarray, "_ D"], ...] | None = None
    examined: tuple[Finding, ...] = ()
    held_out: tuple[str, ...] = ()

    @classmethod
    @refusing(MotionError)
    def from_arrays(
        cls,
        arrays: Sequence[Any] | ndarray,
        channels: Channels | Sequence[str] | str,
        rate_hz: float,
        *,
        observed: Sequence[Any] | None = None,
        units: Mapping[str, str] | None = None,
        ranges: Mapping[str, tuple[float, float]] | None = None,
        names: Sequence[str] | None = None,
        weights: Sequence[Any] | None = None,
    ) -> "Motions":
        """Make motions of arrays [T_i, D] and check them.

        Args:
            arrays: One array per motion, in the channels' units; or one [S, T, D] of them all.
            channels: The channels themselves, or their names.
            rate_hz: Rows per second [Hz].
            observed: One mask [T_i, D] per motion; everything is observed if left out. What is
                not observed may be anything, NaN included.
            units: Units by channel name; empty where left out. For channels given by name.
            ranges: Ranges (low, high) by channel name; from the data with a margin where left
                out. For channels given by name.
            names: One name per motion; numbered where left out.
            weights: One array [T_i, D] ≥ 0 per motion, which weighs the squared error of every
                value in training and recognition: more for a channel that must be met closely,
                less for rows that are known badly. A value of weight 0 is still the network's
                input if it was observed; one that was not observed has no weight.

        Raises:
            MotionError: No motions; a motion of fewer than two rows, of another width, with a
                value that is observed and not finite, or with a weight below 0.
            ChannelError: A channel that never changes and has no range given, or a unit or range
                of a channel that is not there.
        """
        if isinstance(channels, str):
            channels = [channels]
        if not (np.isfinite(rate_hz) and rate_hz > 0):
            raise MotionError(f"rate_hz must be finite and > 0, got {rate_hz}")
        labels = channels.names if isinstance(channels, Channels) else tuple(channels)
        values, masks, called = checked(arrays, observed, names, labels)
        if not isinstance(channels, Channels):
            channels = channels_of(values, masks, labels, units or {}, ranges or {})
        counts = None if weights is None else checked_weights(weights, values, called)
        return cls(values, masks, channels, float(rate_hz), called, counts)

    @classmethod
    @refusing(RecordingError)
    def read(
        cls, path: str | Path, *, format: str | None = None, stored: bool = False, **given: Any
    ) -> "Motions":
        """Read recordings: csv, .npz, LeRobot, EIPL, hdf5, ROS bags, mcap; a file or a folder.

        Args:
            path: The file or folder.
            format: One of `recordings.FORMATS`; found from what is there where left out.
            stored: Whether the motions are left where they are, and each is read when it is
                needed: what does not fit into memory is trained on in batches. Of a
                LeRobotDataset, robomimic's HDF5 and our own .npz; without what looks at all motions
                together: `trim`, `unwrap`, `quaternions`, `leaps`, `binary`.
            given: Any of `recordings.OPTIONS`, which say what is what in a file: `episode`, `time`,
                `columns` of tables, `topics`, `pause`, `marker` of logs; and any of
                `recordings.Choice`: `channels`, `exclude`, `rate_hz`, `resample_hz`, `trim`, `nan`,
                `units`, `ranges`, `margin`, `episodes`, `skip`, `unwrap`, `quaternions`, `leaps`,
                `binary`, `strict`.

        Raises:
            RecordingError: Nothing that can be read there, or a rate that is not told.
            SettingError: A choice that does not exist or is not allowed.
            MotionError: Values that are not finite, or an episode of fewer than two rows.
            ChannelError: A channel that does not exist, or that never changes.
        """
        told = {name: given.pop(name) for name in OPTIONS if name in given}
        chosen = choose(**given)
        if stored:
            for option in (name for name, value in told.items() if value is not None):
                raise RecordingError(f"{path}: {option} is not for recordings left where they are")
            ready, episodes = prepare_stored(read_stored(path, format), chosen)
            return replace(
                cls.from_recording(ready),
                values=StoredArrays(episodes, "values"),
                observed=StoredArrays(episodes, "observed"),
            )
        return cls.from_recording(prepare(read_recording(path, format, **told), chosen))

    @classmethod
    def from_recording(cls, recording: Recording) -> "Motions":
        """Return the motions of a recording that was prepared."""
        assert recording.rate_hz is not None
        motions = cls.from_arrays(
            [e.values for e in recording.episodes],
            recording.channels,
            recording.rate_hz,
            observed=[e.observed for e in recording.episodes],
            units=dict(zip(recording.channels, recording.units, strict=True)),
            ranges=recording.ranges,
            names=[e.name for e in recording.episodes],
        )
        channels = [replace(c, binary=recording.binary.get(c.name)) for c in motions.channels]
        return replace(
            motions,
            channels=Channels(channels),
            examined=recording.findings,
            held_out=recording.held_out,
        )

    @refusing(RecordingError)
    def write(self, path: str | Path, format: str | None = None) -> None:
        """Write the motions without their weights, whole or not at all.

        Args:
            path: The file or folder to write.
            format: One of `recordings.FORMATS`; from the suffix of `path` where left out.

        Raises:
            RecordingError: The format cannot hold them, or `path` cannot be written.
            SettingError: A format that does not exist, or none given and none told by `path`.
        """
        names = self.channels.names
        units = tuple(c.unit for c in self.channels)
        ranges = {c.name: (c.low, c.high) for c in self.channels}
        rows = zip(self.names, self.values, self.observed, strict=True)
        kept = tuple(Episode(name, None, value, mask) for name, value, mask in rows)
        binary = {c.name: c.binary for c in self.channels if c.binary is not None}
        recording = Recording(
            Path(path), names, units, ranges, self.rate_hz, kept, names, binary, self.set_apart
        )
        write_recording(path, recording, format)

    @property
    def lengths(self) -> tuple[int, ...]:
        """Rows of every motion."""
        if isinstance(self.values, StoredArrays):
            return tuple(motion.rows for motion in self.values.motions)
        return tuple(len(v) for v in self.values)

    @property
    def stored(self) -> bool:
        """Whether the motions are read when they are needed."""
        return isinstance(self.values, StoredArrays)

    @property
    def contents(self) -> tuple[object, ...]:
        """What tells these motions from others: digests of stored ones, the batch of others."""
        if isinstance(self.values, StoredArrays):
            scale = str([(c.low, c.high) for c in self.channels])
            return (scale, *(motion.digest for motion in self.values.motions))
        return self.batch()

    @property
    def set_apart(self) -> tuple[str, ...]:
        """Names of the motions here that the recording sets apart for testing."""
        return tuple(name for name in self.names if name in self.held_out)

    @refusing(MotionError)
    def chosen(self, which: Sequence[int | str] | int | str) -> "Motions":
        """Return the motions of these names or indices, in this order.

        Raises:
            MotionError: A name or index that is not there, or none at all.
        """
        rows = [self._row(one) for one in several(which)]
        if not rows:
            raise MotionError("no motions chosen; at least one is needed")
        return replace(
            self,
            values=_picked(self.values, rows),
            observed=_picked(self.observed, rows),
            names=tuple(self.names[i] for i in rows),
            weights=self.weights and tuple(self.weights[i] for i in rows),
        )

    def showing(self, channels: Sequence[str | int] | str | int) -> "Motions":
        """Return the same motions with only some channels observed, by name or number."""
        seen = np.zeros(len(self.channels), dtype=bool)
        seen[self.channels.indices(channels)] = True
        return replace(self, observed=tuple(mask & seen for mask in self.observed))

    @refusing(ChannelError)
    def scaled_by(self, channels: Channels) -> "Motions":
        """Return the same values, to be mapped to the unit interval by other channels."""
        return replace(self, channels=channels)

    @refusing(MotionError)
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
        kind = np.dtype(jnp.result_type(float))
        sensed = np.full((count, rows, len(self.channels)), 0.5, kind)
        observed, weight = np.zeros(sensed.shape, kind), np.zeros(sensed.shape, kind)
        motions = zip(self.values, self.observed, self.weights or self.observed, strict=True)
        for i, (value, mask, counts) in enumerate(motions):
            unit = self.channels.to_unit(np.where(mask, value, 0.0))
            sensed[i, : len(value)] = np.where(mask, unit, 0.5)
            observed[i, : len(value)] = mask
            weight[i, : len(value)] = mask * counts
        return Batch(*map(jnp.asarray, (sensed, observed, weight)))

    def pieces(self, rows: int) -> Iterator[tuple[range, tuple[int, int]]]:
        """Yield which motions make up so many rows at most, and what their batch is padded to."""
        longest = max(self.lengths)
        size = min(max(rows // longest, 1), len(self))
        for first in range(0, len(self), size):
            yield range(first, min(first + size, len(self))), (size, longest)

    def batches(self, rows: int) -> Iterator[tuple[range, Batch]]:
        """Yield the pieces of so many rows at most as batches, all of one shape."""
        for which, (size, longest) in self.pieces(rows):
            yield which, self.chosen(which).batch(longest, size)

    def __len__(self) -> int:
        return len(self.values)

    def __getitem__(self, index: int) -> "Motions":
        """Return one motion as Motions."""
        return self.chosen([range(len(self))[index]])

    def __iter__(self) -> Iterator["Motions"]:
        return (self[i] for i in range(len(self)))

    def _row(self, which: int | str) -> int:
        if isinstance(which, str):
            if which not in self.names:
                raise MotionError(unknown("motion", which, self.names))
            return self.names.index(which)
        if not 0 <= which < len(self):
            raise MotionError(f"unknown motion {which}; there are {len(self)}, counted from 0")
        return int(which)


def _picked(
    arrays: tuple[ndarray, ...] | StoredArrays, rows: Sequence[int]
) -> tuple[ndarray, ...] | StoredArrays:
    if isinstance(arrays, StoredArrays):
        return arrays.chosen(rows)
    return tuple(arrays[i] for i in rows)
