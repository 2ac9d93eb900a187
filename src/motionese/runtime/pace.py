"""When a loop's cycles begin: on a grid fixed at its start, so that lateness never adds up."""

import math

from motionese.runtime.clock import Clock


class Pace:
    """Keeps a loop to its rate and counts what came late."""

    def __init__(self, clock: Clock, rate_hz: float) -> None:
        self.missed = self.skipped = 0
        self.worst_lateness_s = 0.0
        self._clock, self._period_s = clock, 1 / rate_hz
        self._origin, self._cycle = clock.now(), 0

    def wait(self) -> None:
        """Return when the next cycle is to begin."""
        self._clock.sleep_until(self._origin + self._cycle * self._period_s)

    def done(self) -> None:
        """Say that the cycle has sent its command. Periods that have begun by then are skipped."""
        since = self._clock.now() - self._origin
        lateness = since - self._cycle * self._period_s
        self.worst_lateness_s = max(self.worst_lateness_s, lateness)
        following = max(self._cycle + 1, math.ceil(since / self._period_s))
        self.missed += lateness > self._period_s
        self.skipped += following - self._cycle - 1
        self._cycle = following
