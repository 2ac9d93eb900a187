"""A trained model as the robot holds it: its arrays, channels and initial states, never changed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy import ndarray

from motionese.arguments import place_of, refusing
from motionese.errors import ControlError, unknown
from motionese.time_constants import LONGEST, SHORTEST, scaled_tau
from motionese.unit_interval import from_unit, logit, sigmoid, to_unit

Reading = Mapping[str, float | None] | Sequence[float] | ndarray | None
"""Values by channel name (a channel may be left out), one per channel, or None: no new reading."""


@dataclass
class State:
    """The state of one running motion; it belongs to one step at a time.

    Attributes:
        u: Potentials of all units. [N]
        y: Their outputs; those of the first D units are the channels' present row. [N]
    """

    u: ndarray
    y: ndarray

    def copy(self) -> "State":
        """Return a state of its own, to try a motion out from here."""
        return State(self.u.copy(), self.y.copy())


@dataclass(frozen=True, eq=False)
class RuntimeModel:
    """A trained network for a control loop. It has no state: any number of states can share it.

    Attributes:
        weights: `weights[i, j]` leads from unit j to unit i; 0 where nothing is wired. [N, N]
        bias: Added to every unit's summed input. [N]
        tau: Time constants [steps]. [N]
        channels: Names of the D channels; the first D units stand for them.
        units: The channels' units.
        low: Lower end of every channel's range [its unit]. [D]
        high: Upper end of every channel's range [its unit]. [D]
        rate_hz: Steps per second of the motions it learned [Hz]; None if the file does not tell.
        initial_states: u_0 of every learned motion by its name. [N] each
        lengths: Rows of every learned motion by its name; empty if the file does not tell.
        senses_first: Whether the potentials of the channels' units begin at what is sensed first;
            otherwise they begin at 0, and what is sensed is the first input alone.
        binary: The two values at which a channel is held, the lower first; NaN for all others.
            [D, 2]
    """

    weights: ndarray
    bias: ndarray
    tau: ndarray
    channels: tuple[str, ...]
    units: tuple[str, ...]
    low: ndarray
    high: ndarray
    rate_hz: float | None
    initial_states: Mapping[str, ndarray]
    lengths: Mapping[str, int]
    senses_first: bool
    binary: ndarray

    @property
    def size(self) -> int:
        """Number of units N."""
        return len(self.bias)

    def named(self, motion: str | int) -> str:
        """Return the name of a learned motion by its name or place; `ControlError` if none is."""
        names = list(self.initial_states)
        return names[place_of("initial state", motion, names, ControlError)]

    def initial(self, motion: str | int) -> ndarray:
        """Return a learned motion's u_0 [N]; `ControlError` for one that is not there."""
        return self.initial_states[self.named(motion)].copy()

    @refusing(ControlError)
    def begin(self, start: str | int | ndarray, here: Reading = None) -> State:
        """Return a state from which the model moves on.

        Args:
            start: The name or place of a learned motion, or initial states [N], such as recognised
                ones.
            here: Where the robot is, in the channels' units: values by channel name, or one per
                channel. A channel that is left out (or NaN) begins where the learned motion did.

        Raises:
            ControlError: A name or channel that does not exist, or values that are not finite.
        """
        u = (
            self.initial(start)
            if isinstance(start, str | int | np.integer)
            else self._checked(start)
        )
        return self.state_at(u, self.to_unit(row_of(here, self.channels)))

    def state_at(self, u: ndarray, here: ndarray) -> State:
        """Return a state that begins where the robot is.

        Args:
            u: Initial states, all units; taken over. [N]
            here: Where the robot is, in the unit interval; NaN where that is not known. [D]
        """
        known = np.flatnonzero(np.isfinite(here))
        if self.senses_first:
            u[known] = logit(here[known])
        y = sigmoid(u)
        y[known] = here[known]
        return State(u, y)

    def _checked(self, start: Any) -> ndarray:
        u = np.array(start, dtype=np.float32)
        if u.shape != (self.size,):
            raise ControlError(
                f"initial states must have one value per unit ({self.size}), got shape {u.shape}"
            )
        if not np.isfinite(u).all():
            raise ControlError("initial states must be finite; recognition may have diverged")
        return u

    @refusing(ControlError)
    def with_duration(self, scale: float) -> "RuntimeModel":
        """Return the model with its motions lasting `scale` times as long.

        Raises:
            SettingError: A scale outside 0.5 to 2, or too small for the smallest time constant.
        """
        tau = scaled_tau(self.tau, scale)
        lengths = {name: 1 + round((rows - 1) * scale) for name, rows in self.lengths.items()}
        return replace(self, tau=tau, lengths=lengths)

    @refusing(ControlError)
    def with_rate(self, rate_hz: float) -> "RuntimeModel":
        """Return the model for another rate [Hz], half to twice its own; motions last as long.

        Raises:
            ControlError: A rate beyond these, or a model whose file does not tell its rate.
            SettingError: The smallest time constant would be shorter than a step.
        """
        if self.rate_hz is None:
            raise ControlError("the model's file does not tell its rate; train and save it anew")
        if not SHORTEST <= rate_hz / self.rate_hz <= LONGEST:
            raise ControlError(
                f"a model of {self.rate_hz:g} Hz can be run at {SHORTEST * self.rate_hz:g} to "
                f"{LONGEST * self.rate_hz:g} Hz, got {rate_hz:g} Hz"
            )
        return replace(self.with_duration(rate_hz / self.rate_hz), rate_hz=float(rate_hz))

    def to_unit(self, values: ndarray) -> ndarray:
        """Map values [D] in the channels' units to the unit interval; NaN stays NaN."""
        return to_unit(values, self.low, self.high - self.low)

    def from_unit(self, values: ndarray) -> ndarray:
        """Map the unit interval [D] to the channels' units."""
        return from_unit(values, self.low, self.high - self.low)

    def held(self, values: ndarray) -> ndarray:
        """Return values [D] in the channels' units, binary channels at the nearer of their two."""
        low, high = self.binary.T
        return np.where(np.isnan(low), values, np.where(values > (low + high) / 2, high, low))

    def per_channel(self, what: str, values: float | Mapping[str, Any], other: Any) -> list[Any]:
        """Spread one value, or values by channel name, over the channels.

        Args:
            what: What the values are, for the sentence about a channel that does not exist.
            values: One for all channels, or by name.
            other: The value of channels that are not named.
        """
        if not isinstance(values, Mapping):
            return [values] * len(self.channels)
        for name in values:
            if name not in self.channels:
                raise ControlError(f"{what}: {unknown('channel', name, self.channels)}")
        return [values.get(name, other) for name in self.channels]


def row_of(reading: Reading, channels: Sequence[str]) -> ndarray:
    """Return a reading [D] in the channels' units; NaN where nothing finite was read.

    Raises:
        ControlError: A channel that does not exist, a value that is no number, another width.
    """
    if reading is None:
        return np.full(len(channels), np.nan)
    if isinstance(reading, Mapping):
        for name in reading:
            if name not in channels:
                raise ControlError(f"reading: {unknown('channel', name, channels)}")
        reading = [np.nan if (v := reading.get(name)) is None else v for name in channels]
    try:
        row = np.array(reading, dtype=np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise ControlError(f"a reading must hold numbers, got {reading!r}") from error
    if row.shape != (len(channels),):
        raise ControlError(
            f"a reading must hold one value per channel ({', '.join(channels)}), "
            f"got shape {row.shape}"
        )
    row[~np.isfinite(row)] = np.nan
    return row
