"""Many runs at once: processes of one core each, restarted when they die, told of as they go."""

import logging
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from itertools import islice
from multiprocessing import resource_tracker
from typing import NamedTuple

import dask
from distributed import Client, Future, LocalCluster, as_completed, get_worker
from distributed.scheduler import KilledWorker

from motionese.errors import MotioneseError, StorageError
from motionese.experiment.run import Run, go_through
from motionese.experiment.study import Study
from motionese.imitation import Recordings
from motionese.one_core import one_core_each

LOOPS = "loops"
"""The topic under which workers tell of their loops."""


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
    workers: int,
    *,
    loop_done: Callable[[Job, int], None],
    run_ended: Callable[[Job, str], None],
) -> list[str]:
    """Do what is left of many runs; a run that cannot go on does not keep the others from it.

    Args:
        jobs: The runs, each of another name; those that are finished cost nothing.
        workers: How many runs at once, each in a process of its own.
        loop_done: Called with a run and its last whole loop, also when it begins.
        run_ended: Called with a run and why it could not go on, or "".

    Returns:
        For every run that could not go on, a sentence why.
    """
    left = longest_first(jobs)
    if not left:
        return []
    by_name, waiting = {job.name: job for job in left}, iter(left)
    failures = []
    with _client(min(workers, len(left))) as client:

        def begin(count: int) -> list[Future]:
            return [
                client.submit(_go_through, job, key=job.name, pure=False)
                for job in islice(waiting, count)
            ]

        client.subscribe_topic(LOOPS, lambda event: loop_done(by_name[event[1][0]], event[1][1]))
        going = as_completed(begin(workers))
        for future in going:
            job, failure = by_name[future.key], _failure(future)
            run_ended(job, failure)
            if failure:
                failures.append(f"{job.name}: {failure}")
            going.update(begin(1))
    return failures


def longest_first(jobs: Sequence[Job]) -> list[Job]:
    """Return the runs that have not ended, so ordered that workers finish at about the same time.

    A run is longer the more loops are left, and among those of one seed the longer its lessons.
    """

    def key(job: Job) -> tuple[int, int, int]:
        stages = job.settings.development(job.run.condition)
        primitives = sum(len(sequence.primitives) for each in stages for sequence in each.lesson)
        return job.run.loops_done() - job.loops, job.run.seed, -primitives

    return sorted((job for job in jobs if not job.run.ended()), key=key)


def _go_through(job: Job) -> str:
    """Do a run in a worker; return why it cannot go on, or ""."""

    def loop_done(loop: int) -> None:
        get_worker().log_event(LOOPS, (job.name, loop))

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


def _failure(future: Future) -> str:
    """Return why a run could not go on, or ""; anything unforeseen is raised."""
    try:
        return str(future.result())
    except KilledWorker:
        return (
            "its process was killed again and again, perhaps for want of memory; "
            "the same command goes on from its last whole loop"
        )


@contextmanager
def _client(workers: int) -> Iterator[Client]:
    # Ctrl-C reaches the whole group of processes, but is for the first one alone: threads and
    # processes made while it is blocked keep it blocked, workers that are restarted included.
    # The resource tracker would unblock it if it were started by them.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        with (
            one_core_each(),
            dask.config.set({"logging.distributed": "critical"}),
            _cluster(workers) as cluster,
            Client(cluster) as client,
        ):
            try:
                signal.pthread_sigmask(signal.SIG_SETMASK, before)
                yield client
            except BaseException:
                _kill(cluster)
                raise
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _cluster(workers: int) -> LocalCluster:
    return LocalCluster(
        n_workers=workers,
        threads_per_worker=1,
        processes=True,
        memory_limit=0,
        host="127.0.0.1",
        dashboard_address="127.0.0.1:0",
        worker_dashboard_address="127.0.0.1:0",
        silence_logs=logging.CRITICAL,
    )


def _kill(cluster: LocalCluster) -> None:
    """Kill the workers: asked to stop they would finish their loops first, and need not."""
    for logger in ("asyncio", "tornado.application"):
        # They would tell of every connection that is lost by this.
        logging.getLogger(logger).setLevel(logging.CRITICAL)
    for nanny in cluster.workers.values():
        nanny.auto_restart = False
        if nanny.pid:
            with suppress(ProcessLookupError):
                os.kill(nanny.pid, signal.SIGKILL)
