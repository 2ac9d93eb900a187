"""The clock a control loop runs by: never set back, read finely, and on time."""

import time
from typing import Protocol, runtime_checkable

SPIN_S = 0.0005
"""How long before its time a sleeper wakes, to wait the rest awake: sleep alone is 0.1 ms late."""


@runtime_checkable
class Clock(Protocol):
    """What a control loop asks of its clock."""

    def now(self) -> float:
        """Return the time [s] since some fixed moment."""
        ...

    def sleep_until(self, moment: float) -> None:
        """Return at that time [s], or at once if it has passed."""
        ...


class MonotonicClock:
    """The machine's monotonic clock."""

    def now(self) -> float:
        """Return the time [s] since some fixed moment."""
        return time.perf_counter()

    def sleep_until(self, moment: float) -> None:
        """Sleep, then wait awake for the last half millisecond."""
        asleep = moment - SPIN_S - time.perf_counter()
        if asleep > 0:
            time.sleep(asleep)
        while time.perf_counter() < moment:
            pass
