"""The whole command, in a process of its own: stopped and killed, it goes on to the same bits."""

import os
import random
import signal
import time

import psutil
import pytest
from small_runs import SMALL, left_on_disk

REPRODUCE = [
    *("reproduce", "--quick", "--seeds", "5,6", "--conditions", "TD/MD", "--workers", "2"),
    *("--out", "runs/a", "--set", *SMALL),
]
RUN = "runs/a/TD-MD/seed-5"


def wait_for(path):
    deadline = time.monotonic() + 120
    while not path.exists():
        assert time.monotonic() < deadline, f"{path} was not written"
        time.sleep(0.01)


def started_by(process):
    return psutil.Process(process.pid).children(recursive=True)


def left_alive(processes):
    return psutil.wait_procs(processes, timeout=10)[1]


@pytest.mark.slow
def test_ctrl_c_stops_it_at_once_and_the_same_command_goes_on(begin, here, undisturbed):
    process = begin(*REPRODUCE)
    wait_for(here / RUN / "loop-01.safetensors")
    workers = started_by(process)
    os.killpg(process.pid, signal.SIGINT)
    began = time.monotonic()
    output, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert errors == "\nmotionese: stopped; the same command goes on\n"
    assert time.monotonic() - began < 10
    assert not left_alive(workers)
    assert output.startswith("The report will be at runs/a/report.html\n2 runs: TD/MD, each with")

    output, errors = (process := begin(*REPRODUCE)).communicate(timeout=120)
    assert (process.returncode, errors) == (0, "")
    first, *lines, last = output.splitlines()
    assert first == "The report will be at runs/a/report.html"
    assert "go on from a checkpoint" in lines[1]
    assert last == "Report: runs/a/report.html"
    assert (here / "runs/a/report.html").is_file()
    assert left_on_disk(here / RUN) == undisturbed


def test_ctrl_c_stops_it_while_it_starts_its_workers(begin):
    process = begin(*REPRODUCE)
    while not process.stdout.readline().startswith("3 loops a run"):
        assert process.poll() is None
    time.sleep(0.3)
    os.killpg(process.pid, signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert process.returncode == 130
    assert errors == "\nmotionese: stopped; the same command goes on\n"


@pytest.mark.slow
def test_several_presets_go_through_one_pool_and_end_with_one_report(begin, here, undisturbed):
    several = [*REPRODUCE, "--preset", "default", "order", "--seeds", "5-5"]
    output, errors = (process := begin(*several)).communicate(timeout=240)
    assert process.returncode == 0, errors
    assert output.splitlines()[3].startswith("3 loops a run, 2 at a time; ")
    assert output.splitlines()[-1] == "Report of all: runs/a/report.html"
    assert left_on_disk(here / "runs/a/default/TD-MD/seed-5") == undisturbed
    reports = {path.relative_to(here).as_posix() for path in here.rglob("report.html")}
    assert reports == {f"runs/a/{name}report.html" for name in ("", "default/", "order/")}


@pytest.mark.slow
def test_killed_at_any_moment_it_leaves_no_process_and_goes_on(
    begin, here, undisturbed, monkeypatch
):
    monkeypatch.delenv("JAX_COMPILATION_CACHE_DIR")
    monkeypatch.setenv("XDG_CACHE_HOME", str(here / "cache"))
    moments = random.Random(0)
    for _ in range(4):
        process = begin(*REPRODUCE)
        wait_for(here / RUN)
        time.sleep(moments.uniform(0, 4))
        workers = started_by(process)
        process.kill()
        process.communicate(timeout=60)
        assert not left_alive(workers)
    process = begin(*REPRODUCE)
    process.communicate(timeout=120)
    assert process.returncode == 0
    assert left_on_disk(here / RUN) == undisturbed
    assert not list(here.rglob("*.part"))
    assert list(here.glob("cache/motionese/compiled-*/*"))
