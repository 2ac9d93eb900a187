"""Progress over all runs: bars on a terminal, now and then a line elsewhere."""

import math
import time
from collections.abc import Sequence
from types import TracebackType

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TaskID,
    TextColumn,
)
from rich.text import Text

from motionese.experiment.run import Run

LINE_EVERY_S = 20.0
WHOLE_HISTORY_S = 1e9
"""Loops come in bursts, with compilation between them: only the whole history gives a rate."""


class _TimeLeft(ProgressColumn):
    """How long all runs will take, once compilation no longer distorts it."""

    def render(self, task: Task) -> Text:
        return Text(_time_left(task))


class Display:
    """One display for many runs: all loops of all runs, and the runs under way."""

    def __init__(self, console: Console, runs: Sequence[Run], loops: int) -> None:
        """Prepare for runs of so many loops each, counting what they have done already."""
        self._console, self._loops = console, loops
        self._done = {run.name: loops if run.ended() else run.loops_done() for run in runs}
        self._left = sum(run.ended() is None for run in runs)
        self._rows: dict[str, TaskID] = {}
        self._said = time.monotonic()
        self._progress = Progress(
            TextColumn("{task.description}"),
            BarColumn(),
            MofNCompleteColumn(),
            TextColumn("loops"),
            _TimeLeft(),
            console=console,
            transient=True,
            speed_estimate_period=WHOLE_HISTORY_S,
        )
        done, total = sum(self._done.values()), loops * len(runs)
        self._all = self._progress.add_task(
            "all runs", total=total, completed=done, told_from=100 * (0.9 * done / total + 0.1)
        )

    def __enter__(self) -> "Display":
        if self._console.is_terminal:
            self._progress.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._console.is_terminal:
            self._progress.stop()

    def loop_done(self, run: Run, loop: int) -> None:
        """Show a run's last whole loop; its row appears with the first one that is told."""
        if run.name not in self._rows:
            self._rows[run.name] = self._progress.add_task(
                run.name, total=self._loops, told_from=math.inf
            )
        doing = run.name if loop < self._loops else f"{run.name}, evaluation"
        self._progress.update(self._rows[run.name], completed=loop, description=doing)
        self._advance(run, loop)
        if time.monotonic() - self._said > LINE_EVERY_S:
            self._say("going on")

    def run_ended(self, run: Run, failure: str) -> None:
        """Take a run off the display."""
        self._left -= 1
        if run.name in self._rows:
            self._progress.update(self._rows[run.name], visible=False)
        self._advance(run, self._loops)
        self._say(f"{run.name} {'cannot go on' if failure else 'ended'}")

    def _advance(self, run: Run, loop: int) -> None:
        # A run whose process died begins again at its checkpoint, perhaps before what was told.
        further = max(loop - self._done[run.name], 0)
        self._done[run.name] += further
        self._progress.advance(self._all, further)

    def _say(self, news: str) -> None:
        if self._console.is_terminal:
            return
        self._said = time.monotonic()
        task = self._progress.tasks[0]
        runs = f"{self._left} run{'' if self._left == 1 else 's'} to go"
        parts = [runs, f"{task.completed:g} of {task.total:g} loops", _time_left(task)]
        self._console.print(f"{news}; {', '.join(filter(None, parts))}")


def _time_left(task: Task) -> str:
    """Return how long a task will take in words, or "" before a tenth of it is done."""
    seconds = task.time_remaining
    if not seconds or task.finished or task.percentage < task.fields["told_from"]:
        return ""
    return f"about {seconds:.0f} s left" if seconds < 100 else f"about {seconds / 60:.0f} min left"
