"""A run that was stopped ends with the same bits as one that was not."""

import pytest
from small_runs import left_on_disk

from motionese.errors import StorageError
from motionese.experiment.conditions import condition
from motionese.experiment.run import Run, go_through


class StoppedError(Exception):
    pass


def stopped_after(run, small_settings, loop):
    def told(done):
        if done == loop:
            raise StoppedError

    with pytest.raises(StoppedError):
        go_through(run, small_settings, told)


def test_it_leaves_a_table_of_everything(undisturbed):
    assert undisturbed.keys() == {
        "loop-01.safetensors",
        "loop-02.safetensors",
        "loop-03.safetensors",
        "loops.csv",
        "development.csv",
        "triples.csv",
        "slow_state_map.csv",
        "inside.npz",
        "ended.json",
    }
    assert len(undisturbed["loops.csv"]) == 5 + 4 + 4
    assert len(undisturbed["triples.csv"]) == 7
    assert len(undisturbed["slow_state_map.csv"]) == 5 * 2 * 2


def test_stopped_after_every_loop_it_ends_with_the_same_bits(tmp_path, small_settings, undisturbed):
    run = Run(condition("TD/MD"), 5, tmp_path)
    assert (run.loops_done(), run.ended()) == (0, None)
    for loop in (1, 2, 3):
        stopped_after(run, small_settings, loop)
        assert (run.loops_done(), run.ended()) == (loop, None)
    assert go_through(run, small_settings, lambda loop: None)["status"] == "finished"
    assert left_on_disk(tmp_path) == undisturbed


def test_another_seed_ends_with_other_bits(tmp_path, small_settings, undisturbed):
    go_through(Run(condition("TD/MD"), 6, tmp_path), small_settings, lambda loop: None)
    other = left_on_disk(tmp_path)
    assert other.keys() == undisturbed.keys()
    assert other["loop-01.safetensors"] != undisturbed["loop-01.safetensors"]


def test_with_a_cut_checkpoint_it_waits_for_its_removal(tmp_path, small_settings, undisturbed):
    run = Run(condition("TD/MD"), 5, tmp_path)
    stopped_after(run, small_settings, 2)
    checkpoint = tmp_path / "loop-02.safetensors"
    checkpoint.write_bytes(checkpoint.read_bytes()[:1000])
    with pytest.raises(StorageError, match=r"loop-02\.safetensors: .*cut short"):
        go_through(run, small_settings, lambda loop: None)
    checkpoint.unlink()
    go_through(run, small_settings, lambda loop: None)
    assert left_on_disk(tmp_path) == undisturbed


def test_a_damaged_ending_is_told_with_what_to_do(tmp_path, small_settings):
    run = Run(condition("TD/MD"), 5, tmp_path)
    (tmp_path / "ended.json").write_text('{"status": "fin')
    with pytest.raises(StorageError, match=r"ended\.json: cannot be read; remove it"):
        go_through(run, small_settings, lambda loop: None)
