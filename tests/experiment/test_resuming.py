"""A run that was stopped ends with the same bits as one that was not."""

import numpy as np
import pytest
from small_runs import SMALL, StoppedError, left_on_disk, stopped_after

from motionese.body import open_body
from motionese.caregiver import ScriptedCaregiver
from motionese.errors import RunFolderError, StorageError
from motionese.experiment import Run, condition_named, go_through, read_settings
from motionese.experiment.digests import list_files
from motionese.task import PUSHING_BUTTONS

TD_MD = condition_named("TD/MD", read_settings().factors)


def test_it_leaves_a_table_of_everything(undisturbed):
    assert undisturbed.keys() == {
        "loop-01.safetensors",
        "loop-02.safetensors",
        "loop-03.safetensors",
        "loops.csv",
        "development.csv",
        "triples.csv",
        "slow_state_map.csv",
        "online.csv",
        "switches.csv",
        "exchanges.csv",
        "lesions.csv",
        "decoding.csv",
        "symbols.csv",
        "boundaries.csv",
        "inside.npz",
        "ended.json",
        "SHA256SUMS",
    }
    assert undisturbed["SHA256SUMS"] == undisturbed.keys() - {"SHA256SUMS"}
    assert len(undisturbed["loops.csv"]) == 5 + 4 + 4
    assert len(undisturbed["triples.csv"]) == 7
    assert len(undisturbed["slow_state_map.csv"]) == 5 * 2 * 2
    assert len(undisturbed["online.csv"]) == (4 + 7) * 1
    assert len(undisturbed["switches.csv"]) == 1


@pytest.mark.slow
def test_what_was_a_lesson_as_a_whole_is_nowhere_new(tmp_path):
    small = read_settings(
        overrides=[*SMALL, "stages.1.until.loops=1", "stages.1.lesson=pairs and triples"],
        quick=True,
    )
    go_through(Run(TD_MD, 5, tmp_path), small, lambda loop: None)
    left = left_on_disk(tmp_path)
    new = {s.name for s in PUSHING_BUTTONS.lesson("triples")} - {"UR ↓↑←", "UR ↓↑↓"}
    assert {row["motion"] for row in left["triples.csv"]} == new
    assert {row["motion"] for row in left["online.csv"] if row["taught"] == "False"} == new


@pytest.mark.slow
def test_stopped_after_every_loop_it_ends_with_the_same_bits(tmp_path, small_settings, undisturbed):
    run = Run(TD_MD, 5, tmp_path)
    assert (run.loops_done(), run.ended()) == (0, None)
    for loop in (1, 2, 3):
        stopped_after(run, small_settings, loop)
        assert (run.loops_done(), run.ended()) == (loop, None)
    assert go_through(run, small_settings, lambda loop: None)["status"] == "finished"
    assert left_on_disk(tmp_path) == undisturbed


@pytest.mark.slow
def test_another_seed_ends_with_other_bits(tmp_path, small_settings, undisturbed):
    go_through(Run(TD_MD, 6, tmp_path), small_settings, lambda loop: None)
    other = left_on_disk(tmp_path)
    assert other.keys() == undisturbed.keys()
    assert other["loop-01.safetensors"] != undisturbed["loop-01.safetensors"]


@pytest.mark.slow
def test_a_file_that_changed_is_told_and_made_again_as_is_said(
    tmp_path, small_settings, undisturbed
):
    run = Run(TD_MD, 5, tmp_path)
    stopped_after(run, small_settings, 2)
    checkpoint, listing = tmp_path / "loop-02.safetensors", tmp_path / "SHA256SUMS"

    def refused(what):
        with pytest.raises(RunFolderError) as caught:
            go_through(run, small_settings, lambda loop: None)
        assert what in str(caught.value)

    flip(checkpoint, -1)
    refused(
        "loop-02.safetensors has changed since it was written: remove it, the checkpoints of "
        "later loops and ended.json, and the same `motionese reproduce` command repeats"
    )
    checkpoint.unlink()
    go_through(run, small_settings, lambda loop: None)
    assert left_on_disk(tmp_path) == undisturbed
    for name, removed in (("loops.csv", "ended.json beside it"), ("ended.json", "it")):
        flip(tmp_path / name, 30)
        refused(f"{name} has changed since it was written: remove {removed}, and the same")
        (tmp_path / "ended.json").unlink()
        go_through(run, small_settings, lambda loop: None)
        assert left_on_disk(tmp_path) == undisturbed
    flip(listing, 30)
    refused(f"{listing} has changed since it was written: remove {tmp_path}, and the same")
    for asked in (run.ended, run.loops_done):
        with pytest.raises(RunFolderError, match=f"remove {tmp_path}, and the same"):
            asked()


def flip(path, place):
    """Change one bit of a file."""
    content = bytearray(path.read_bytes())
    content[place] ^= 1
    path.write_bytes(content)


@pytest.mark.slow
def test_what_a_killed_process_did_not_come_to_list_is_done_again(
    tmp_path, small_settings, undisturbed, monkeypatch
):
    run = Run(TD_MD, 5, tmp_path)
    stopped_after(run, small_settings, 2)

    def killed(folder, names):
        raise StoppedError

    for done in (2, 3):
        with monkeypatch.context() as patch, pytest.raises(StoppedError):
            patch.setattr("motionese.experiment.run.list_files", killed)
            go_through(run, small_settings, lambda loop: None)
        assert (run.loops_done(), run.ended()) == (done, None)
        if done == 2:
            stopped_after(run, small_settings, 3)
    assert (tmp_path / "ended.json").exists()
    go_through(run, small_settings, lambda loop: None)
    assert left_on_disk(tmp_path) == undisturbed


@pytest.mark.parametrize(
    ("name", "seed", "overrides", "told"),
    [
        ("TD/MND", 5, [], "a checkpoint of loop 1 of TD/MD seed 5, settings"),
        ("TD/MD", 6, [], "where one of TD/MD seed 6, settings"),
        ("TD/MD", 5, ["training.epochs=6"], "where one of TD/MD seed 5, settings"),
    ],
)
def test_a_checkpoint_of_another_run_or_other_settings_is_refused(
    tmp_path, small_settings, name, seed, overrides, told
):
    stopped_after(Run(TD_MD, 5, tmp_path), small_settings, 1)
    settings = read_settings(overrides=[*SMALL, *overrides], quick=True)
    with pytest.raises(StorageError) as error:
        go_through(
            Run(condition_named(name, small_settings.factors), seed, tmp_path), settings, print
        )
    assert told in str(error.value)


def test_a_checkpoint_under_another_loop_s_name_is_refused(tmp_path, small_settings):
    run = Run(TD_MD, 5, tmp_path)
    stopped_after(run, small_settings, 1)
    path = tmp_path / "loop-01.safetensors"
    path.with_name("loop-02.safetensors").write_bytes(path.read_bytes())
    list_files(tmp_path, ["loop-02.safetensors"])
    with pytest.raises(StorageError, match="a checkpoint of loop 1 of TD/MD"):
        go_through(run, small_settings, print)


@pytest.mark.slow
def test_recorded_demonstrations_stand_in_for_the_scripted_caregiver(tmp_path, small_settings):
    manner = small_settings.caregiver.model_copy(update={"variability_mm": 0.0})
    body = open_body(small_settings.body, PUSHING_BUTTONS)
    scripted, rng = ScriptedCaregiver(PUSHING_BUTTONS, manner, body), np.random.default_rng(0)
    motions = [m for length in (1, 2, 3) for m in PUSHING_BUTTONS.sequences(length)]
    recorded = {m.name: [scripted.demonstrate(m, rng)] for m in motions}
    run = Run(TD_MD, 5, tmp_path)
    ended = go_through(run, small_settings, lambda loop: None, recorded)
    assert ended["status"] == "finished"
    with np.load(tmp_path / "inside.npz") as kept:
        shown = kept["shown.UR ↓↑←"]
    np.testing.assert_allclose(shown, recorded["UR ↓↑←"][0].path, atol=1e-9)
