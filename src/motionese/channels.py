"""What is sensed: named channels with a unit and a range, and their mapping to the unit interval.

Scaling belongs to the channels, not to the data: a saved network carries its channels with it.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.arguments import place_of, refusing, several
from motionese.errors import ChannelError, kind_of
from motionese.unit_interval import INNER_HIGH, INNER_LOW, from_unit, to_unit


@refusing(ChannelError)
@dataclass(frozen=True)
class Channel:
    """One sensed quantity.

    Attributes:
        name: Of no other channel beside it.
        unit: Empty where unknown.
        low, high: The range [unit] it is expected in.
        binary: The two values [unit] at which it is held when it is generated, the lower first;
            None for a quantity of any value.
    """

    name: str
    unit: str
    low: float
    high: float
    binary: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            raise ChannelError(
                f"channel '{self.name}': its range must be finite with low < high, "
                f"got {self.low} to {self.high} {self.unit}"
            )
        if self.binary is not None and not self.low <= self.binary[0] < self.binary[1] <= self.high:
            raise ChannelError(
                f"channel '{self.name}': its two values must rise within its range "
                f"{self.low} to {self.high} {self.unit}, got {self.binary}"
            )


class Channels(Sequence[Channel]):
    """The channels of a body or a recording, in the order of the columns of its arrays."""

    @refusing(ChannelError)
    def __init__(self, channels: Iterable[Channel]) -> None:
        self._channels = tuple(channels)
        for channel in self._channels:
            if not isinstance(channel, Channel):
                raise ChannelError(f"channels must be of the kind Channel, got {kind_of(channel)}")
        if not self._channels:
            raise ChannelError("no channels given; at least one is needed")
        doubled = sorted({n for n in self.names if self.names.count(n) > 1})
        if doubled:
            raise ChannelError(f"channel names must be unique; doubled: {', '.join(doubled)}")
        self._low = np.array([c.low for c in self._channels])
        self._span = np.array([c.high - c.low for c in self._channels])

    @property
    def names(self) -> tuple[str, ...]:
        """The channels' names, in order."""
        return tuple(c.name for c in self._channels)

    @property
    def spans(self) -> Float[ndarray, " D"]:
        """The width of each channel's range, in its unit."""
        return np.array(self._span)

    @property
    def interval_widths(self) -> Float[ndarray, " D"]:
        """How much of each channel's unit the whole unit interval stands for."""
        return np.asarray(self._span / (INNER_HIGH - INNER_LOW))

    @refusing(ChannelError)
    def indices(self, names: Iterable[str | int] | str | int) -> Int[ndarray, " K"]:
        """Return the columns of channels by name or number; `ChannelError` for one not here."""
        columns = [place_of("channel", one, self.names, ChannelError) for one in several(names)]
        return np.array(columns, dtype=np.int64)

    def to_unit(self, values: Float[ndarray, "*shape"]) -> Float[ndarray, "*shape"]:
        """Map values [the channels' units], last axis the channels, to the unit interval."""
        self._check_width(values)
        return to_unit(values, self._low, self._span)

    def from_unit(self, values: Float[ndarray, "*shape"]) -> Float[ndarray, "*shape"]:
        """Map the unit interval, last axis the channels, back to the channels' units."""
        self._check_width(values)
        return from_unit(values, self._low, self._span)

    def held(self, values: Float[ndarray, "*shape"]) -> Float[ndarray, "*shape"]:
        """Return values [the channels' units], binary channels at the nearer of their two."""
        result = np.array(values)
        for column, channel in enumerate(self._channels):
            if channel.binary is not None:
                low, high = channel.binary
                above = result[..., column] > (low + high) / 2
                result[..., column] = np.where(above, high, low)
        return result

    def _check_width(self, values: Float[ndarray, "*shape"]) -> None:
        if values.ndim == 0 or values.shape[-1] != len(self):
            raise ChannelError(
                f"the last axis must hold the {len(self)} channels {', '.join(self.names)}; "
                f"got an array of shape {values.shape}"
            )

    @overload
    def __getitem__(self, index: int) -> Channel: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Channel]: ...
    def __getitem__(self, index: int | slice) -> Channel | Sequence[Channel]:
        return self._channels[index]

    def __len__(self) -> int:
        return len(self._channels)

    def __eq__(self, other: Any) -> bool:
        return isinstance(other, Channels) and self._channels == other._channels

    def __hash__(self) -> int:
        return hash(self._channels)

    def __repr__(self) -> str:
        return f"Channels({', '.join(f'{c.name} [{c.unit}]' for c in self._channels)})"
