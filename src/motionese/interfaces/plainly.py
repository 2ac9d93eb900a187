"""One sentence instead of a traceback, and the exit status that goes with it."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import typer

from motionese.errors import MotioneseError
from motionese.interfaces.interrupt import interruptible

WRONG, INTERRUPTED = 2, 130
"""Exit statuses: of what the user can put right, and of Ctrl-C."""


@contextmanager
def plainly(stopped: str | Callable[[], str]) -> Iterator[None]:
    """Say in one sentence what the user can put right, or that Ctrl-C has stopped the command.

    That includes files that the system refuses to read or write, as on a full disk.

    Args:
        stopped: What to say after Ctrl-C, or a function that returns it then.
    """
    try:
        with interruptible():
            yield
    except MotioneseError as error:
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
