"""Where runs are done: in processes here, or by the workers of a Dask scheduler."""

import logging
import os
import signal
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager, suppress
from importlib.util import find_spec
from multiprocessing import resource_tracker
from pathlib import Path
from typing import NamedTuple

import dask
from distributed import Client, LocalCluster

from motionese.errors import SettingError
from motionese.experiment.environment import versions
from motionese.one_core import one_core_each
from motionese.worker_plugin import MARK, UNFIT, OneRunAtATime

ANSWERS_WITHIN_S = 10
"""How long a scheduler may take to answer."""


class Workers(NamedTuple):
    """Processes that do a run each.

    Attributes:
        client: What runs are given to.
        many: How many runs can be done at a time, now.
        each: What of a worker's resources a run takes.
    """

    client: Client
    many: Callable[[], int]
    each: dict[str, int]


OpenedWorkers = AbstractContextManager[Workers]


@contextmanager
def local_workers(count: int, told: Callable[[str], None]) -> Iterator[Workers]:
    """Start worker processes of one core each on this machine, restarted when they die.

    Args:
        count: How many.
        told: Called with a sentence that tells the address of Dask's dashboard, if there is one.
    """
    # Ctrl-C reaches the whole group of processes, but is for the first one alone: threads and
    # processes made while it is blocked keep it blocked, workers that are restarted included.
    # The resource tracker would unblock it if it were started by them.
    resource_tracker.ensure_running()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        with (
            one_core_each(),
            dask.config.set({"logging.distributed": "critical"}),
            _cluster(count) as cluster,
            Client(cluster) as client,
        ):
            try:
                signal.pthread_sigmask(signal.SIG_SETMASK, before)
                _tell_dashboard(client, told)
                yield Workers(client, lambda: count, {})
            except BaseException:
                _kill(cluster)
                raise
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def workers_of(
    scheduler: str, files: Sequence[Path], told: Callable[[str], None]
) -> Iterator[Workers]:
    """Use the workers of a scheduler that are fit; see `motionese.worker_plugin`.

    Args:
        scheduler: Its address, such as tcp://10.0.0.5:8786.
        files: What all of them must see, as it is here.
        told: Called with a sentence about a worker that is not fit, or that there is none yet.

    Raises:
        SettingError: It does not answer, or none of its workers is fit.
    """
    with dask.config.set({"logging.distributed": "critical"}), client_of(scheduler) as client:
        yield prepared(client, f"--scheduler {scheduler}", files, told)


def client_of(scheduler: str) -> Client:
    """Return a client of a scheduler; `SettingError` where none answers."""
    try:
        return Client(scheduler, timeout=ANSWERS_WITHIN_S)
    except (OSError, ValueError) as error:
        raise SettingError(
            f"--scheduler {scheduler}: no Dask scheduler answers there ({error}); start one with "
            "`dask scheduler`, which prints its address"
        ) from error


def prepared(
    client: Client, where: str, files: Sequence[Path], told: Callable[[str], None]
) -> Workers:
    """Return the workers of a client that are fit; arguments and errors as of `workers_of`."""
    _tell_dashboard(client, told)
    try:
        client.register_plugin(OneRunAtATime(versions(), files))
    except (ImportError, AttributeError) as error:
        raise SettingError(
            f"{where}: a worker has no motionese, or another than this command ({error}); the bits "
            "could differ"
        ) from error
    unfit = {address: reason for _, (address, reason) in client.get_events(UNFIT)}

    def count() -> int:
        known = client.scheduler_info()["workers"].values()
        return sum(bool(worker["resources"].get(MARK)) for worker in known)

    present = client.scheduler_info()["workers"]
    left_out = [f"worker {a}: {unfit[a]}" for a in present if a in unfit]
    if present and not count():
        raise SettingError(f"{where}: no worker can do runs; {'; '.join(left_out)}")
    for sentence in left_out:
        told(f"Left out: {sentence}")
    if not present:
        told(f"{where}: no worker yet; the runs begin as soon as there is one")
    client.subscribe_topic(UNFIT, lambda event: told("Left out: worker {}: {}".format(*event[1])))
    return Workers(client, count, {MARK: 1})


def _tell_dashboard(client: Client, told: Callable[[str], None]) -> None:
    # Without bokeh there is an address, but nothing that it shows.
    if find_spec("bokeh") and "dashboard" in client.scheduler_info()["services"]:
        told(f"Dask's dashboard: {client.dashboard_link}")


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
