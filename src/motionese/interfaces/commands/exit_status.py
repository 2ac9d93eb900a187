"""One sentence instead of a traceback, the exit status that goes with it, and Ctrl-C."""

import signal
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import TYPE_CHECKING

import typer

from motionese.errors import MotioneseError

if TYPE_CHECKING:
    from rich.console import Console

WRONG, INTERRUPTED = 2, 130
"""Exit statuses: of what the user can put right, and of Ctrl-C."""
AGAIN_AFTER_S = 0.1


@contextmanager
def plainly(stopped: str | Callable[[], str], *, soft_wrap: bool = True) -> Iterator["Console"]:
    """Yield where a command prints; say in one sentence what the user can put right, or Ctrl-C.

    That includes files that the system refuses to read or write, as on a full disk.

    Args:
        stopped: What to say after Ctrl-C, or a function that returns it then.
        soft_wrap: Whether lines may be longer than the terminal is wide.
    """
    try:
        with interruptible():
            from rich.console import Console  # noqa: PLC0415

            yield Console(markup=False, highlight=False, soft_wrap=soft_wrap)
    except MotioneseError as error:
        for note in getattr(error, "__notes__", []):
            typer.echo(f"! {note}", err=True)
        raise _left(str(error)) from error
    except OSError as error:
        if error.filename is None:
            raise
        raise _left(f"{error.filename}: {error.strerror or error}") from error
    except KeyboardInterrupt as error:
        told = stopped if isinstance(stopped, str) else stopped()
        typer.echo(f"\nmotionese: {told}", err=True)
        raise typer.Exit(INTERRUPTED) from error


def _left(sentence: str) -> typer.Exit:
    """Say a sentence on one line, whatever names are in it, and return how to leave."""
    typer.echo(f"motionese: {' '.join(sentence.split())}", err=True)
    return typer.Exit(WRONG)


@contextmanager
def interruptible() -> Iterator[None]:
    """Raise `KeyboardInterrupt` at Ctrl-C, again until it is on its way, and then never again.

    Code that must not raise, as in garbage collection, may swallow it.
    """
    numbers = signal.SIGINT, signal.SIGALRM
    handlers = {number: signal.signal(number, _interrupt) for number in numbers}
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
