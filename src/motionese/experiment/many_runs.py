"""Many runs at once: given to workers, given again when these die, told of as they go."""

from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from queue import Empty, Queue
from typing import NamedTuple
from uuid import uuid4

from distributed import CancelledError, Future, get_worker
from distributed.scheduler import KilledWorker

from motionese.errors import MotioneseError, StorageError
from motionese.experiment.run import Run, go_through
from motionese.experiment.study import Study
from motionese.experiment.workers import OpenedWorkers, Workers
from motionese.imitation import Recordings

LOOK_EVERY_S = 1.0
"""How often it is looked for further workers."""
GONE = "the scheduler is gone; what was finished is kept, and the same command goes on"


class UnfinishedRunsError(MotioneseError):
    """Runs that could not go on, each with its reason; what was finished is kept."""


class Job(NamedTuple):
    """A run, and what it takes to go through it.

    Attributes:
        recordings: Demonstrations that are shown in the place of scripted ones.
        series: What is told before the run's name, where that alone does not tell it from others.
    """

    run: Run
    settings: Study
    recordings: Recordings | None = None
    series: str = ""

    @property
    def name(self) -> str:
        """How people are told of it, such as 'TD/MD seed 100' or 'order TD/MD seed 100'."""
        return f"{self.series} {self.run.name}" if self.series else self.run.name

    @property
    def loops(self) -> int:
        """How many loops it has at most."""
        return self.settings.most_loops()


def go_through_all(
    jobs: Sequence[Job],
    opened: OpenedWorkers,
    *,
    loop_done: Callable[[Job, int], None],
    run_ended: Callable[[Job, str], None],
) -> list[str]:
    """Do what is left of many runs; a run that cannot go on does not keep the others from it.

    Args:
        jobs: The runs, each of another name; those that are finished cost nothing.
        opened: The workers that do them; they are let go afterwards.
        loop_done: Called with a run and its last whole loop, also when it begins.
        run_ended: Called with a run and why it could not go on, or "".

    Returns:
        For every run that could not go on, a sentence why.
    """
    left = longest_first(jobs)
    if not left:
        return []
    by_name, failures = {job.name: job for job in left}, []
    with opened as workers:
        runs = _Runs(workers, left)
        workers.client.subscribe_topic(
            runs.topic, lambda event: loop_done(by_name[event[1][0]], event[1][1])
        )
        for job, failure in runs:
            run_ended(job, failure)
            if failure:
                failures.append(f"{job.name}: {failure}")
    return [*failures, *([GONE] if runs.waiting else [])]


def longest_first(jobs: Sequence[Job]) -> list[Job]:
    """Return the runs that have not ended, so ordered that workers finish at about the same time.

    A run is longer the more loops are left, and among those of one seed the longer its lessons.
    """

    def key(job: Job) -> tuple[int, int, int]:
        stages = job.settings.development(job.run.condition)
        primitives = sum(len(sequence.primitives) for each in stages for sequence in each.lesson)
        return job.run.loops_done() - job.loops, job.run.seed, -primitives

    return sorted((job for job in jobs if not job.run.ended()), key=key)


class _Runs:
    """Runs that are given to workers, the first ones first, as many as these can do at a time."""

    def __init__(self, workers: Workers, jobs: Sequence[Job]) -> None:
        self.waiting, self.topic = deque(jobs), f"loops-{workers.client.id}"
        self._workers = workers
        self._given: dict[Future, tuple[Job, int]] = {}
        self._ended: Queue[Future] = Queue()

    def __iter__(self) -> Iterator[tuple[Job, str]]:
        """Yield runs as they end, each with why it could not go on, or "".

        Where the scheduler goes, those that are left are `waiting` again.
        """
        while self.waiting or self._given:
            try:
                self._give()
                future = self._ended.get(timeout=LOOK_EVERY_S)
            except Empty:
                continue
            except OSError:
                break
            if future.cancelled():
                break
            job, loops = self._given.pop(future)
            if _killed(future) and job.run.loops_done() > loops:
                self.waiting.appendleft(job)
            else:
                yield job, _failure(future)
        self.waiting.extend(job for job, _ in self._given.values())

    def _give(self) -> None:
        """Give runs to workers that are free; `OSError` if the scheduler is gone."""
        free = self._workers.many() - len(self._given)
        for job in [self.waiting.popleft() for _ in range(min(free, len(self.waiting)))]:
            key = f"{job.name} {uuid4()}"
            there = replace(job.run, folder=job.run.folder.resolve())
            future = self._workers.client.submit(
                *(_go_through, job._replace(run=there), self.topic, key),
                key=key,
                pure=False,
                resources=self._workers.each,
            )
            self._given[future] = job, job.run.loops_done()
            future.add_done_callback(self._ended.put)


def _go_through(job: Job, topic: str, key: str) -> str:
    """Do a run in a worker; return why it cannot go on, or "".

    Its loops are told under a topic; `key` is what the worker knows it by.
    """
    worker = get_worker()

    def loop_done(loop: int) -> None:
        task = worker.state.tasks.get(key)
        if task is None or task.state != "executing":
            raise CancelledError  # nobody waits for it any more
        worker.log_event(topic, (job.name, loop))

    loop_done(job.run.loops_done())
    try:
        go_through(job.run, job.settings, loop_done, job.recordings)
    except StorageError as error:
        return (
            f"{error}; remove it and the checkpoints of later loops, and the same command goes on "
            "from the loop before"
        )
    except MotioneseError as error:
        return str(error)
    except OSError as error:
        return f"{error.filename or job.run.folder}: {error.strerror}; the same command goes on"
    return ""


def _killed(future: Future) -> bool:
    """Whether a run's process was killed again and again."""
    return future.status == "error" and isinstance(future.exception(), KilledWorker)


def _failure(future: Future) -> str:
    """Return why a run could not go on, or ""; anything unforeseen is raised."""
    try:
        return str(future.result())
    except KilledWorker:
        return (
            "its process was killed again and again, perhaps for want of memory; "
            "the same command goes on from its last whole loop"
        )
