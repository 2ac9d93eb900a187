"""A run that was stopped ends with the same bits as one that was not."""

import numpy as np
import pytest
from small_runs import SMALL, left_on_disk, stopped_after

from motionese.body import open_body
from motionese.caregiver import ScriptedCaregiver
from motionese.errors import StorageError
from motionese.experiment import Run, condition_named, go_through, read_settings
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
    }
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


def test_with_a_cut_checkpoint_it_waits_for_its_removal(tmp_path, small_settings, undisturbed):
    run = Run(TD_MD, 5, tmp_path)
    stopped_after(run, small_settings, 2)
    checkpoint = tmp_path / "loop-02.safetensors"
    checkpoint.write_bytes(checkpoint.read_bytes()[:1000])
    with pytest.raises(StorageError, match=r"loop-02\.safetensors: .*cut short"):
        go_through(run, small_settings, lambda loop: None)
    checkpoint.unlink()
    go_through(run, small_settings, lambda loop: None)
    assert left_on_disk(tmp_path) == undisturbed


def test_a_damaged_ending_is_told_with_what_to_do(tmp_path, small_settings):
    run = Run(TD_MD, 5, tmp_path)
    (tmp_path / "ended.json").write_text('{"status": "fin')
    with pytest.raises(StorageError, match=r"ended\.json: cannot be read; remove it"):
        go_through(run, small_settings, lambda loop: None)


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
    with pytest.raises(StorageError, match="a checkpoint of loop 1 of TD/MD"):
        go_through(run, small_settings, print)


@pytest.mark.parametrize("content", ["[1]", "7", "{}", "", "{"])
def test_an_ending_that_is_none_is_refused(tmp_path, content):
    (tmp_path / "ended.json").write_text(content)
    with pytest.raises(StorageError, match="remove it, and the run is evaluated again"):
        Run(TD_MD, 5, tmp_path).ended()


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
