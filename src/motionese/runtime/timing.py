"""The clock of a control loop, the grid of its cycles, and a watchdog for when it hangs."""

import math
import time
from collections.abc import Callable
from threading import Event, Lock, Thread
from types import TracebackType

SPIN_S = 0.0005
"""How long before its time a sleeper wakes, to wait the rest awake: sleep alone is 0.1 ms late."""


class Clock:
    """The machine's monotonic clock; one that is to be another takes its place as a subclass."""

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


class Pace:
    """Keeps a loop to its rate and counts what came late.

    Cycles begin on a grid fixed at the start, so that lateness never adds up.
    """

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


class Once:
    """A function that is called once, however many ask for it."""

    def __init__(self, function: Callable[[], None] | None) -> None:
        self._function, self._lock = function, Lock()

    def __call__(self) -> None:
        """Call the function if nobody has before."""
        with self._lock:
            function, self._function = self._function, None
        if function is not None:
            function()


class Watchdog:
    """Calls `stop` from a thread of its own when `beat` has not been called for too long.

    Nothing can run beside a loop that hangs inside foreign code which holds Python's lock: a robot
    needs a watchdog of its own as well.
    """

    def __init__(self, patience_s: float, stop: Callable[[], None]) -> None:
        self.barked = False
        self._patience_s, self._stop = patience_s, stop
        self._over = Event()
        self._beaten = time.perf_counter()
        self._thread = Thread(target=self._watch, name="motionese watchdog", daemon=True)

    def beat(self) -> None:
        """Say that the loop is alive."""
        self._beaten = time.perf_counter()

    def __enter__(self) -> "Watchdog":
        self.beat()
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self._over.set()
        self._thread.join(self._patience_s)

    def _watch(self) -> None:
        while not self._over.wait(self._patience_s / 10):
            if time.perf_counter() - self._beaten > self._patience_s:
                self.barked = True
                self._stop()
                return
