"""A thread that watches over a loop and stops the robot when the loop hangs."""

from collections.abc import Callable
from threading import Event, Lock, Thread
from time import perf_counter
from types import TracebackType


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
        self._beaten = perf_counter()
        self._thread = Thread(target=self._watch, name="motionese watchdog", daemon=True)

    def beat(self) -> None:
        """Say that the loop is alive."""
        self._beaten = perf_counter()

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
            if perf_counter() - self._beaten > self._patience_s:
                self.barked = True
                self._stop()
                return
