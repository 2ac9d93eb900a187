"""Progress of all runs, or of one training: bars on a terminal, now and then a line elsewhere."""

import math
import time
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    ProgressColumn,
    Task,
    TaskID,
    TextColumn,
    TimeRemainingColumn,
)
from rich.progress import Progress as Bars
from rich.table import Column
from rich.text import Text

from motionese.learning import Progress

if TYPE_CHECKING:
    from motionese.experiment.many_runs import Job

LINE_EVERY_S, TRAINING_LINE_EVERY_S = 20.0, 10.0
WHOLE_HISTORY_S, TRAINING_HISTORY_S = 1e9, 60.0
"""How far back the time left is told from. Loops come in bursts, with compilation between them:
only the whole history gives a rate."""

# Not `Self`, which the tests' checks of annotations refuse outside a checked class.
Own = TypeVar("Own", bound="_Display")


class _Display:
    """Bars while it is entered, if the console is a terminal."""

    def __init__(self, console: Console, *columns: ProgressColumn, **how: Any) -> None:
        self._console, self._said = console, time.monotonic()
        self._bars = Bars(*columns, console=console, transient=True, **how)

    def __enter__(self: Own) -> Own:
        if self._console.is_terminal:
            self._bars.start()
        return self

    def __exit__(self, *left: object) -> None:
        if self._console.is_terminal:
            self._bars.stop()

    def _say(self, parts: Sequence[str], *, after_s: float = -1.0) -> None:
        """Write a line where there are no bars, if the last is so long ago."""
        if not self._console.is_terminal and time.monotonic() - self._said > after_s:
            self._said = time.monotonic()
            self._console.print("; ".join(filter(None, parts)))


class Display(_Display):
    """One display for many runs: all loops of all runs, and the runs under way."""

    def __init__(self, console: Console, jobs: Sequence["Job"]) -> None:
        """Prepare for the loops of all runs, counting what they have done already."""
        shown = TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn()
        after = TextColumn("loops"), _TimeLeft()
        super().__init__(console, *shown, *after, speed_estimate_period=WHOLE_HISTORY_S)
        done = {job.name: job.loops if job.run.ended() else job.run.loops_done() for job in jobs}
        self._done, self._left = done, sum(job.run.ended() is None for job in jobs)
        self._failed, self._rows = 0, dict[str, TaskID]()
        part, total = sum(done.values()), sum(job.loops for job in jobs)
        self._all = self._bars.add_task(
            "all runs", total=total, completed=part, told_from=100 * (0.9 * part / total + 0.1)
        )

    def say(self, sentence: str) -> None:
        """Write a sentence, above the bars where there are any."""
        self._console.print(sentence)

    def loop_done(self, job: "Job", loop: int) -> None:
        """Show a run's last whole loop; its row appears with the first one that is told."""
        if job.name not in self._rows:
            row = self._bars.add_task(job.name, total=job.loops, told_from=math.inf)
            self._rows[job.name] = row
            self._count()
        doing = job.name if loop < job.loops else f"{job.name}, evaluation"
        self._bars.update(self._rows[job.name], completed=loop, description=doing)
        self._advance(job, loop)
        self._say(["going on", self._to_go()], after_s=LINE_EVERY_S)

    def run_ended(self, job: "Job", failure: str) -> None:
        """Take a run off the display."""
        self._left -= 1
        self._failed += bool(failure)
        if job.name in self._rows:
            self._bars.update(self._rows.pop(job.name), visible=False)
        self._count()
        self._advance(job, job.loops)
        self._say([f"{job.name} {'cannot go on' if failure else 'ended'}", self._to_go()])

    def _count(self) -> None:
        """Show how many runs are done, under way, and could not go on."""
        done = len(self._done) - self._left - self._failed
        failed = f", {self._failed} failed" if self._failed else ""
        told = f"{done} of {len(self._done)} runs done, {len(self._rows)} running{failed}"
        self._bars.update(self._all, description=told)

    def _advance(self, job: "Job", loop: int) -> None:
        # A run whose process died begins again at its checkpoint, perhaps before what was told.
        further = max(loop - self._done[job.name], 0)
        self._done[job.name] += further
        self._bars.advance(self._all, further)

    def _to_go(self) -> str:
        task = self._bars.tasks[0]
        runs = f"{self._left} run{'' if self._left == 1 else 's'} to go"
        parts = [runs, f"{task.completed:g} of {task.total:g} loops", _time_left(task)]
        return ", ".join(filter(None, parts))


class _TimeLeft(ProgressColumn):
    """How long all runs will take, once compilation no longer distorts it."""

    def render(self, task: Task) -> Text:
        return Text(_time_left(task))


def _time_left(task: Task) -> str:
    """Return how long a task will take in words, or "" before a tenth of it is done."""
    seconds = task.time_remaining
    if not seconds or task.finished or task.percentage < task.fields["told_from"]:
        return ""
    return f"about {seconds:.0f} s left" if seconds < 100 else f"about {seconds / 60:.0f} min left"


class TrainingDisplay(_Display):
    """Shows epochs, loss, errors in closed loop, and the time left of one training."""

    def __init__(self, console: Console, epochs: int, done: int) -> None:
        """Prepare for so many epochs, some of them done before."""
        super().__init__(
            console,
            BarColumn(bar_width=None),
            MofNCompleteColumn(table_column=Column(no_wrap=True)),
            TextColumn("{task.description}", table_column=Column(no_wrap=True)),
            TimeRemainingColumn(compact=True, table_column=Column(no_wrap=True)),
            expand=True,
            speed_estimate_period=TRAINING_HISTORY_S,
        )
        self._epochs = epochs
        self._task = self._bars.add_task("", total=epochs, completed=done)

    def show(self, progress: Progress) -> None:
        """Show how far training is."""
        parts = [f"loss {progress.loss:.3g}", f"closed loop {progress.closed_loop_error:.1%}"]
        if progress.validation_error is not None:
            parts.append(f"held out {progress.validation_error:.1%}")
        told = f"{', '.join(parts)} of range"
        self._bars.update(self._task, completed=progress.epoch, description=told)
        seconds = self._bars.tasks[0].time_remaining
        left = f"about {seconds:.0f} s left" if seconds else ""
        epochs = f"{progress.epoch} of {self._epochs} epochs"
        self._say([epochs, told, left], after_s=TRAINING_LINE_EVERY_S)
