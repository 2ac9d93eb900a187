"""Forty runs on one worker and on two, and by a scheduler whose workers are killed.

    python benchmarks/many_runs.py

Tells how much sooner two workers are done than one, and whether every run left the same bits. Runs
are those of a quick trial with a few loops: what is measured is how runs are spread. Everything is
compiled by a first run, which does not count.
"""

import hashlib
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import psutil
from distributed import Client

from motionese.experiment import Study, read_settings
from motionese.experiment.many_runs import Job, go_through_all
from motionese.experiment.run_folder import SETTINGS, open_run_folder
from motionese.experiment.workers import OpenedWorkers, local_workers, workers_of

SEEDS = 10
KILL_EVERY_S = 20.0
TABLES = ("triples.csv", "slow_state_map.csv", "inside.npz")
"""What is compared; other tables tell seconds too."""


def study() -> Study:
    return read_settings(overrides=["stages.0.until.loops=3", "stages.1.until.loops=3"], quick=True)


def gone_through(folder: Path, settings: Study, seeds: int, opened: OpenedWorkers) -> float:
    """Go through all runs; return how long it took [s]."""
    folder.mkdir(parents=True, exist_ok=True)
    with open_run_folder(folder, settings, "default") as own:
        jobs = [
            Job(own.run(c, seed), settings) for seed in range(seeds) for c in settings.conditions
        ]
        began = time.perf_counter()
        failures = go_through_all(
            jobs, opened, loop_done=lambda job, loop: None, run_ended=lambda job, failure: None
        )
    assert not failures, failures
    return time.perf_counter() - began


def digest(folder: Path) -> str:
    files = sorted(path for name in TABLES for path in folder.glob(f"*/*/{name}"))
    whole = hashlib.sha256()
    for path in files:
        whole.update(path.relative_to(folder).as_posix().encode() + path.read_bytes())
    return f"{len(files)} files, {whole.hexdigest()[:12]}"


@contextmanager
def scheduler(workers: int) -> Iterator[tuple[str, psutil.Process]]:
    """Start a scheduler and workers in processes of their own; yield its address, and theirs."""
    python = [sys.executable, "-m", "distributed.cli.dask_"]
    with TemporaryDirectory() as at:
        file = f"{at}/scheduler.json"
        how = ["--scheduler-file", file, "--no-dashboard"]
        commands = (
            [*python[:2], f"{python[2]}scheduler", "--host", "127.0.0.1", "--port", "0", *how],
            [
                *python[:2],
                f"{python[2]}worker",
                "--nworkers",
                str(workers),
                "--nthreads",
                "1",
                *how,
            ],
        )
        processes = [subprocess.Popen(c, stderr=subprocess.DEVNULL) for c in commands]
        with Client(scheduler_file=file, timeout=60) as client:
            client.wait_for_workers(workers, timeout=120)
            address = client.scheduler.address
        try:
            yield address, psutil.Process(processes[1].pid)
        finally:
            for process in reversed(processes):
                process.terminate()
                process.wait()


def kill_one_now_and_then(
    parent: psutil.Process, ended: threading.Event, killed: list[int]
) -> None:
    while not ended.wait(KILL_EVERY_S):
        spawned = [
            p for p in parent.children(recursive=True) if "spawn_main" in " ".join(p.cmdline())
        ]
        if spawned:
            spawned[len(killed) % len(spawned)].kill()
            killed.append(len(spawned))


def main() -> None:
    settings = study()
    with TemporaryDirectory() as at:
        root = Path(at)
        gone_through(root / "first", settings, 1, local_workers(1, print))
        seconds = {}
        for count in (1, 2):
            folder = root / f"{count}"
            seconds[count] = gone_through(folder, settings, SEEDS, local_workers(count, print))
            print(f"{count} workers: {seconds[count]:.0f} s; {digest(folder)}")
        print(f"two workers are {seconds[1] / seconds[2]:.2f} times as fast as one")
        by_a_scheduler(root / "scheduler", settings)


def by_a_scheduler(folder: Path, settings: Study) -> None:
    """Let four workers of a scheduler do all runs, and kill one of them every twenty seconds."""
    folder.mkdir()
    with scheduler(4) as (address, parent):
        ended, killed = threading.Event(), list[int]()
        with open_run_folder(folder, settings, "default"):
            opened = workers_of(address, [folder / SETTINGS], print)
        thread = threading.Thread(target=kill_one_now_and_then, args=(parent, ended, killed))
        thread.start()
        took = gone_through(folder, settings, SEEDS, opened)
        ended.set()
        thread.join()
    print(f"a scheduler with 4 workers, {len(killed)} killed: {took:.0f} s; {digest(folder)}")


if __name__ == "__main__":
    main()
