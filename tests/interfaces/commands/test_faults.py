"""The whole command among faults: killed again and again, on a full disk, it loses nothing."""

import os
import random
import shutil
import signal
import subprocess
import time

import psutil
import pytest
from small_runs import SMALL, left_on_disk

from motionese.experiment.conditions import condition_named
from motionese.experiment.run import Run, go_through

STUDY = [
    *("reproduce", "--quick", "--seeds", "5,6", "--conditions", "TD/MD", "TND/MND"),
    *("--workers", "2", "--set", *SMALL),
]
KILLS = 30


@pytest.fixture(scope="module")
def study(tmp_path_factory, small_settings, undisturbed):
    """All that each run of the study leaves, undisturbed, by its folder within the run folder."""
    left = {"TD-MD/seed-5": undisturbed}
    for name, seed in (("TD/MD", 6), ("TND/MND", 5), ("TND/MND", 6)):
        condition, root = (
            condition_named(name, small_settings.factors),
            tmp_path_factory.mktemp("r"),
        )
        go_through(Run(condition, seed, root), small_settings, lambda loop: None)
        left[f"{condition.folder}/seed-{seed}"] = left_on_disk(root)
    return left


def workers_of(process):
    try:
        children = psutil.Process(process.pid).children(recursive=True)
        return [child for child in children if "spawn_main" in " ".join(child.cmdline())]
    except psutil.Error:
        return []


@pytest.mark.slow
def test_after_30_kills_of_workers_and_of_the_command_all_is_as_if_undisturbed(begin, here, study):
    chance, kills, process = random.Random(3), 0, None
    while kills < KILLS:
        if process is None:
            process = begin(*STUDY, "--out", "a")
        time.sleep(chance.uniform(0.5, 6))
        victims = workers_of(process)
        if process.poll() is not None:
            # It came to its end; what is removed is to be done again.
            assert process.returncode in (0, 2)
            shutil.rmtree(here / "a" / chance.choice(sorted(study)))
            process = None
        elif victims and chance.random() < 0.6:
            chance.choice(victims).send_signal(signal.SIGKILL)
            kills += 1
        else:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate(timeout=60)
            process, kills = None, kills + 1
    if process is not None:
        process.communicate(timeout=300)
    _, errors = (process := begin(*STUDY, "--out", "a")).communicate(timeout=300)
    assert process.returncode == 0, errors
    assert {run: left_on_disk(here / "a" / run) for run in study} == study
    assert not list(here.rglob("*.part"))


@pytest.fixture
def small_disk(here):
    """A file system of 700 KiB, and what makes it larger."""
    place = here / "disk"
    place.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=700k", "tmpfs", str(place)]
    if shutil.which("mount") is None or subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("no file system may be mounted here")
    yield place, lambda: subprocess.run(["mount", "-o", "remount,size=100m", place], check=True)
    subprocess.run(["umount", "-l", place], check=True)


@pytest.mark.slow
def test_on_a_full_disk_it_says_so_and_goes_on_where_there_is_room(begin, here, study, small_disk):
    place, enlarge = small_disk
    _, errors = (process := begin(*STUDY, "--out", "disk/a")).communicate(timeout=300)
    assert process.returncode == 2
    assert "No space left on device" in errors
    assert errors.count("\n") == 1
    enlarge()
    _, errors = (process := begin(*STUDY, "--out", "disk/a")).communicate(timeout=300)
    assert process.returncode == 0, errors
    assert {run: left_on_disk(place / "a" / run) for run in study} == study
