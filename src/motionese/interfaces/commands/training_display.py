"""Progress of one training: a bar on a terminal, now and then a line elsewhere."""

import time
from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from rich.table import Column

from motionese.learning import Progress

LINE_EVERY_S = 10.0
HISTORY_S = 60.0
"""How far back the time left is told from."""


class TrainingDisplay:
    """Shows epochs, loss, errors in closed loop, and the time left."""

    def __init__(self, console: Console, epochs: int, done: int) -> None:
        """Prepare for so many epochs, some of them done before."""
        self._console, self._epochs = console, epochs
        self._said = time.monotonic()
        self._bar = Bar(
            BarColumn(bar_width=None),
            MofNCompleteColumn(table_column=Column(no_wrap=True)),
            TextColumn("{task.description}", table_column=Column(no_wrap=True)),
            TimeRemainingColumn(compact=True, table_column=Column(no_wrap=True)),
            console=console,
            transient=True,
            expand=True,
            speed_estimate_period=HISTORY_S,
        )
        self._task = self._bar.add_task("", total=epochs, completed=done)

    def __enter__(self) -> "TrainingDisplay":
        if self._console.is_terminal:
            self._bar.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._console.is_terminal:
            self._bar.stop()

    def show(self, progress: Progress) -> None:
        """Show how far training is."""
        self._bar.update(self._task, completed=progress.epoch, description=_told(progress))
        if not self._console.is_terminal and time.monotonic() - self._said > LINE_EVERY_S:
            self._said = time.monotonic()
            left = self._bar.tasks[0].time_remaining
            self._console.print(
                f"{progress.epoch} of {self._epochs} epochs; {_told(progress)}"
                + (f"; about {left:.0f} s left" if left else "")
            )


def _told(progress: Progress) -> str:
    parts = [
        f"loss {progress.loss:.3g}",
        f"closed loop {progress.closed_loop_error:.1%}",
    ]
    if progress.validation_error is not None:
        parts.append(f"held out {progress.validation_error:.1%}")
    return f"{', '.join(parts)} of range"
