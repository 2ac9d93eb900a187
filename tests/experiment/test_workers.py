"""Workers of a scheduler: the fit ones do runs to the same bits, others are left out by name."""

import os
import signal
import socket
import subprocess
import sys
import time

import psutil
import pytest
from distributed import Client, LocalCluster
from small_runs import left_on_disk

from motionese.errors import SettingError
from motionese.experiment import condition_named
from motionese.experiment.environment import versions
from motionese.experiment.many_runs import GONE, Job, go_through_all
from motionese.experiment.run_folder import SETTINGS, open_run_folder
from motionese.experiment.workers import prepared, workers_of
from motionese.one_core import one_core
from motionese.worker_plugin import OneRunAtATime


@pytest.fixture
def seen(tmp_path):
    file = tmp_path / SETTINGS
    file.write_text("{}")
    return [file]


@pytest.fixture(scope="module")
def client():
    """A client of a worker in this process."""
    with (
        LocalCluster(processes=False, dashboard_address=":0", protocol="inproc") as cluster,
        Client(cluster) as own,
    ):
        yield own


@pytest.fixture
def one_core_here(monkeypatch):
    for name, value in one_core().items():
        monkeypatch.setenv(name, value)


@pytest.mark.usefixtures("one_core_here")
def test_a_worker_that_is_fit_does_one_run_at_a_time(client, seen):
    workers = prepared(client, "here", seen, print)
    assert workers.many() == 1
    assert workers.each == {"motionese": 1}


@pytest.mark.usefixtures("one_core_here")
def test_where_no_worker_is_fit_it_says_why(client, seen, monkeypatch):
    monkeypatch.setattr("motionese.experiment.workers.versions", lambda: {"jax": "0.0.1"})
    with pytest.raises(
        SettingError, match=r"^here: no worker can do runs; worker inproc.* has jax"
    ):
        prepared(client, "here", seen, print)


def test_a_worker_needs_the_same_versions(seen):
    there = versions()
    assert OneRunAtATime({"jax": "0.0.1"}, seen)._unfit() == (
        f"it has jax {there['jax']}, this command 0.0.1: the bits could differ"
    )
    assert "it has no-such not at all" in OneRunAtATime({"no-such": "1"}, seen)._unfit()


def test_a_worker_must_see_the_run_folder(seen):
    plugin = OneRunAtATime({}, seen)
    seen[0].write_text("{} ")
    assert plugin._unfit() == f"it does not see {seen[0]}, which must lie where all workers see it"
    seen[0].unlink()
    assert plugin._unfit().startswith(f"it does not see {seen[0]}")


@pytest.mark.usefixtures("one_core_here")
def test_a_process_that_has_used_jax_otherwise_is_not_fit(seen, monkeypatch):
    assert OneRunAtATime({}, seen)._unfit() == ""
    monkeypatch.setenv("JAX_COMPILATION_CACHE_DIR", "")
    monkeypatch.delenv("OPENBLAS_NUM_THREADS")
    assert "jax has been used in its process" in OneRunAtATime({}, seen)._unfit()


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:{free}", "nowhere", "post://here"])
def test_a_scheduler_that_does_not_answer_is_named(address, monkeypatch):
    monkeypatch.setattr("motionese.experiment.workers.ANSWERS_WITHIN_S", 0.3)
    with socket.socket() as unused:
        unused.bind(("127.0.0.1", 0))
        address = address.format(free=unused.getsockname()[1])
        with (
            pytest.raises(SettingError, match=f"^--scheduler {address}: no Dask scheduler answers"),
            workers_of(address, [], print),
        ):
            pass


@pytest.fixture
def scheduler(tmp_path):
    """A scheduler and four workers, in processes of their own."""
    file = tmp_path / "scheduler.json"
    python = [sys.executable, "-m"]
    how = ["--scheduler-file", str(file), "--no-dashboard"]
    commands = (
        [*python, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", *how],
        [*python, "distributed.cli.dask_worker", "--nworkers", "4", "--nthreads", "2", *how],
    )
    processes = [
        subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)
        for command in commands
    ]
    with Client(scheduler_file=str(file), timeout=60) as client:
        client.wait_for_workers(4, timeout=120)
        address = client.scheduler.address
    yield address, processes
    for process in processes:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


class Told:
    """What is told of runs; does something once the first loop is told."""

    def __init__(self, then):
        self.then, self.ended = then, []

    def loop_done(self, job, loop):
        if loop and self.then:
            then, self.then = self.then, None
            then()

    def run_ended(self, job, failure):
        self.ended.append((job.name, failure))


def jobs_in(folder, settings, seeds):
    condition = condition_named("TD/MD", settings.factors)
    return [Job(folder.run(condition, seed), settings) for seed in seeds]


@pytest.mark.slow
def test_workers_of_a_scheduler_leave_the_same_bits_though_two_are_killed(
    tmp_path, scheduler, small_settings, undisturbed
):
    address, (_, workers) = scheduler

    def kill_two():
        processes = psutil.Process(workers.pid).children(recursive=True)
        spawned = [p for p in processes if "spawn_main" in " ".join(p.cmdline())]
        for process in spawned[:2]:
            process.kill()

    told = Told(kill_two)
    with open_run_folder(tmp_path / "run", small_settings, "default") as folder:
        jobs = jobs_in(folder, small_settings, range(3, 9))
        opened = workers_of(address, [folder.path / SETTINGS], print)
        assert (
            go_through_all(jobs, opened, loop_done=told.loop_done, run_ended=told.run_ended) == []
        )
    assert told.then is None
    assert sorted(name for name, _ in told.ended) == [f"TD/MD seed {n}" for n in range(3, 9)]
    assert left_on_disk(jobs[2].run.folder) == undisturbed


@pytest.mark.slow
def test_when_the_scheduler_dies_it_says_so_and_the_same_command_goes_on(
    tmp_path, scheduler, small_settings, undisturbed
):
    address, (process, _) = scheduler
    told = Told(process.kill)
    with open_run_folder(tmp_path / "run", small_settings, "default") as folder:
        jobs = jobs_in(folder, small_settings, (5,))
        opened = workers_of(address, [folder.path / SETTINGS], print)
        failures = go_through_all(jobs, opened, loop_done=told.loop_done, run_ended=told.run_ended)
        assert failures == [GONE]
    time.sleep(1)
    run = jobs[0].run
    assert run.loops_done() in (1, 2)
