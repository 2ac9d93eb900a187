"""Many runs in processes of their own: all results right, whatever happens to a process."""

import os
import signal
from unittest.mock import Mock

import psutil
import pytest
from distributed import Future
from distributed.scheduler import KilledWorker
from small_runs import left_on_disk

from motionese.experiment import condition_named, read_settings
from motionese.experiment.digests import list_files
from motionese.experiment.many_runs import Job, _failure, go_through_all, longest_first
from motionese.experiment.run import Run
from motionese.experiment.workers import local_workers


class Heard:
    """What the main process is told of the runs, in the order it was told."""

    def __init__(self, on_loop=lambda loop: None):
        self.loops, self.ended, self.on_loop = [], [], on_loop

    def loop_done(self, job, loop):
        self.loops.append((job.name, loop))
        self.on_loop(loop)

    def run_ended(self, job, failure):
        self.ended.append((job.name, failure))

    def go_through_all(self, jobs, workers):
        if isinstance(workers, int):
            workers = local_workers(workers, told=print)
        return go_through_all(jobs, workers, loop_done=self.loop_done, run_ended=self.run_ended)


def workers_of_this_process():
    children = psutil.Process().children(recursive=True)
    return [child for child in children if "spawn_main" in " ".join(child.cmdline())]


@pytest.mark.slow
def test_one_that_cannot_go_on_does_not_keep_the_other_from_it(
    tmp_path, small_settings, undisturbed
):
    good = Run(condition_named("TD/MD", small_settings.factors), 5, tmp_path / "good")
    bad = Run(condition_named("TD/MD", small_settings.factors), 6, tmp_path / "bad")
    bad.folder.mkdir()
    (bad.folder / "loop-01.safetensors").write_bytes(b"cut short")
    list_files(bad.folder, ["loop-01.safetensors"])
    heard = Heard()
    failures = heard.go_through_all([Job(run, small_settings) for run in (bad, good)], 2)
    (failure,) = failures
    assert failure.startswith(f"TD/MD seed 6: {bad.folder / 'loop-01.safetensors'}: ")
    assert "cut short; remove it and the checkpoints of later loops, and" in failure
    assert left_on_disk(good.folder) == undisturbed
    told = [loop for name, loop in heard.loops if name == good.name]
    assert told == [0, 1, 2, 3]
    assert sorted(heard.ended) == [(good.name, ""), (bad.name, failure.split(": ", 1)[1])]
    assert not workers_of_this_process()


@pytest.mark.slow
def test_a_killed_worker_is_replaced_and_its_run_goes_on(tmp_path, small_settings, undisturbed):
    killed = []

    def kill_in_loop_2(loop):
        if loop == 1 and not killed:
            killed.extend(workers_of_this_process())
            for worker in killed:
                os.kill(worker.pid, signal.SIGKILL)

    heard = Heard(kill_in_loop_2)
    run = Run(condition_named("TD/MD", small_settings.factors), 5, tmp_path)
    assert heard.go_through_all([Job(run, small_settings)], 1) == []
    assert len(killed) == 1
    assert [loop for _, loop in heard.loops].count(0) == 1
    assert left_on_disk(tmp_path) == undisturbed


def test_what_is_left_is_ordered_so_that_the_longest_come_first(tmp_path, small_settings):
    runs = [
        Run(c, seed, tmp_path / c.folder / str(seed))
        for c in small_settings.conditions
        for seed in (0, 1, 2)
    ]
    begun, ended = runs[0], runs[-1]
    for run in (begun, ended):
        run.folder.mkdir(parents=True)
    (begun.folder / "loop-01.safetensors").touch()
    (ended.folder / "ended.json").write_text('{"status": "finished"}')
    list_files(begun.folder, ["loop-01.safetensors"])
    list_files(ended.folder, ["ended.json"])
    ordered = [job.run for job in longest_first([Job(run, small_settings) for run in runs])]
    assert len(ordered) == 11
    assert ended not in ordered
    assert ordered[-1] == begun
    assert [run.seed for run in ordered[:3]] == [0, 0, 0]
    assert [run.condition.choices[0] for run in ordered[:3]] == ["TND", "TND", "TD"]


def test_of_several_presets_those_with_more_loops_left_come_first(tmp_path, small_settings):
    longer = read_settings(overrides=["stages.1.until.loops=4"], quick=True)
    condition = condition_named("TD/MD", longer.factors)
    jobs = [
        Job(Run(condition, seed, tmp_path / series / str(seed)), settings, series=series)
        for seed in (0, 1)
        for series, settings in (("short", small_settings), ("long", longer))
    ]
    assert [job.name for job in longest_first(jobs)] == [
        *("long TD/MD seed 0", "long TD/MD seed 1"),
        *("short TD/MD seed 0", "short TD/MD seed 1"),
    ]


def raising(error):
    return Mock(spec=Future, result=Mock(side_effect=error))


def test_a_run_whose_process_dies_again_and_again_is_given_up():
    error = KilledWorker("run", Mock(address="somewhere"), 3)
    assert "killed again and again" in _failure(raising(error))


def test_a_defect_is_not_hidden():
    with pytest.raises(ZeroDivisionError):
        _failure(raising(ZeroDivisionError()))
