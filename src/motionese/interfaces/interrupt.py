"""Ctrl-C that is not lost: code that must not raise, as in garbage collection, may swallow it."""

import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

AGAIN_AFTER_S = 0.1


@contextmanager
def interruptible() -> Iterator[None]:
    """Raise `KeyboardInterrupt` at Ctrl-C, again until it is on its way, and then never again."""
    handlers = {
        number: signal.signal(number, _interrupt) for number in (signal.SIGINT, signal.SIGALRM)
    }
    untold = sys.unraisablehook
    sys.unraisablehook = lambda what: None if what.exc_type is KeyboardInterrupt else untold(what)
    try:
        yield
    finally:
        sys.unraisablehook = untold
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _interrupt(number: int, frame: FrameType | None) -> None:
    if isinstance(sys.exc_info()[1], KeyboardInterrupt):
        return
    signal.setitimer(signal.ITIMER_REAL, AGAIN_AFTER_S)
    raise KeyboardInterrupt
