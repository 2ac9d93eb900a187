"""Limits over time: how many messages, and in which order a drawing's parts may come."""

import time

from motionese.interfaces.teach.messages import MOST_A_SECOND, MOST_AT_ONCE, Pen, RefusedError


class Pace:
    """A page may say so much at once, and so much a second (a leaky bucket)."""

    def __init__(self) -> None:
        """Begin with an empty bucket."""
        self._filled, self._at = 0.0, time.monotonic()

    def one_more(self) -> None:
        """Count a message; `RefusedError` if they come too fast."""
        now = time.monotonic()
        self._filled = max(0.0, self._filled - (now - self._at) * MOST_A_SECOND) + 1.0
        self._at = now
        if self._filled > MOST_AT_ONCE:
            raise RefusedError(f"more than {MOST_A_SECOND:g} messages a second")


class Strokes:
    """The order of a drawing: pen down, moves, pen up; time never goes back."""

    def __init__(self) -> None:
        """Begin with the pen up."""
        self._down, self._last = False, 0.0

    def check(self, pen: Pen) -> None:
        """Take the next part of a drawing; `RefusedError` if it is out of order."""
        if (pen.phase == "down") == self._down:
            raise RefusedError(
                f"out of order: pen {pen.phase} while the pen is {'down' if self._down else 'up'}"
            )
        if pen.phase == "down":
            self._last = 0.0
        for at, _, _ in pen.points:
            if at < self._last:
                raise RefusedError(f"out of order: a point of {at:g} ms after {self._last:g} ms")
            self._last = at
        self._down = pen.phase != "up"
