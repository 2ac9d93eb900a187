"""What a command may be: within its channel's limits, and not too far from the one before."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy import ndarray

from motionese.arguments import refusing
from motionese.errors import ControlError
from motionese.runtime.model import RuntimeModel

FAR = 1.0
"""How far beyond its limits, in their widths, a robot may be when a loop begins."""


@refusing(ControlError)
@dataclass(frozen=True)
class Limits:
    """Limits of the commands, by channel name.

    Attributes:
        ranges: Lowest and highest command [the channel's unit]; the model's range where left out.
        speeds: How fast commands may change [the channel's unit per second]; without a limit where
            left out.
    """

    ranges: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    speeds: Mapping[str, float] = field(default_factory=dict)


class Limiter:
    """Holds commands within limits and counts how often each limit took hold."""

    def __init__(self, model: RuntimeModel, limits: Limits, rate_hz: float) -> None:
        ranges = model.per_channel("limits", limits.ranges, None)
        own = zip(model.low, model.high, strict=True)
        pairs = [mine if given is None else given for given, mine in zip(ranges, own, strict=True)]
        speeds = model.per_channel("limits", limits.speeds, np.inf)
        self._low, self._high = np.array(pairs, dtype=np.float64).T
        self._reach = np.array(speeds, dtype=np.float64) / rate_hz
        self._channels = model.channels
        for name, low, high, reach in zip(
            self._channels, self._low, self._high, self._reach, strict=True
        ):
            if not low < high:
                raise ControlError(
                    f"channel '{name}': its limits must be low < high, got {low:g} to {high:g}"
                )
            if not reach > 0:
                raise ControlError(
                    f"channel '{name}': its speed must be > 0, got {limits.speeds[name]:g}"
                )
        self._clamped = np.zeros(len(self._channels), dtype=np.int64)
        self._slowed = np.zeros(len(self._channels), dtype=np.int64)

    def check_start(self, row: ndarray) -> None:
        """Refuse a first reading [D] that tells of a broken sensor or of another unit.

        Commands are led from there to the limits, so that one has to be able to trust it.

        Raises:
            ControlError: A channel lies beyond its limits by more than their width.
        """
        for name, at, low, high in zip(self._channels, row, self._low, self._high, strict=True):
            if max(low - at, at - high) > FAR * (high - low):
                raise ControlError(
                    f"first reading: channel '{name}' is at {at:g}, far outside its limits "
                    f"{low:g} to {high:g}: check the sensor and its unit, bring the robot nearer, "
                    "or give wider limits"
                )

    def limit(self, wanted: ndarray, before: ndarray) -> ndarray:
        """Return the commands [D] that may be sent after those sent before.

        The speed has the last word: a robot that is beyond a limit is led back at its speed, not
        at once.
        """
        within = np.clip(wanted, self._low, self._high)
        near = np.clip(within, before - self._reach, before + self._reach)
        self._clamped += within != wanted
        self._slowed += near != within
        return np.asarray(near)

    @property
    def clamped(self) -> dict[str, int]:
        """How often every channel's range took hold."""
        return dict(zip(self._channels, self._clamped.tolist(), strict=True))

    @property
    def slowed(self) -> dict[str, int]:
        """How often every channel's speed took hold."""
        return dict(zip(self._channels, self._slowed.tolist(), strict=True))
