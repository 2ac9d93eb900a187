"""What a command may be: within its channel's limits, and not too far from the one before."""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy import ndarray

from motionese.errors import ControlError
from motionese.runtime.model import RuntimeModel


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
