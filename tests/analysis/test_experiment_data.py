"""Putting run folders together: order, failures, missing pieces."""

import json

import pandas as pd
import pytest
from hypothesis import given
from hypothesis import strategies as st
from invented_runs import CONDITIONS, STUDY, condition, list_anew, without_map, write_settings

from motionese.analysis.experiment_data import collect, leading_columns
from motionese.analysis.facts import flat, read_facts
from motionese.errors import RunFolderError

TD_MD, TND_MND = condition("TD/MD"), condition("TND/MND")
LEADING_COLUMNS = leading_columns(STUDY)


def test_rows_are_in_the_order_of_conditions_and_seeds(tmp_path, make_run):
    for seed in (10, 9, 100):
        make_run(tmp_path, TND_MND, seed)
        make_run(tmp_path, TD_MD, seed)
    found = collect(tmp_path)
    order = found.loops[["condition", "seed"]].drop_duplicates().to_numpy().tolist()
    assert order == [[c, s] for c in ("TD/MD", "TND/MND") for s in (9, 10, 100)]
    assert list(found.looks) == ["TD/MD", "TND/MND"]
    for name, columns in LEADING_COLUMNS.items():
        table = found.novel[name] if name in found.novel else getattr(found, name)
        assert list(table.columns)[: len(columns)] == columns


def test_numbers_survive_to_the_last_bit(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    exact = 0.1 + 0.2
    table = pd.read_csv(folder / "loops.csv").assign(imitation_error_cm=exact)
    table.to_csv(folder / "loops.csv", index=False)
    list_anew(folder)
    assert (collect(tmp_path).loops["imitation_error_cm"] == exact).all()


def test_how_runs_ended(tmp_path, make_run):
    make_run(tmp_path, TD_MD, 0)
    make_run(tmp_path, TD_MD, 1, end="diverged")
    make_run(tmp_path, TD_MD, 2, end="unfinished")
    found = collect(tmp_path)
    assert found.runs["status"].to_list() == ["finished", "diverged", "unfinished"]
    assert found.runs["reason"].to_list() == [
        "", "loop 2: diverged at epoch 3", "stopped after loop 2"
    ]  # fmt: skip
    assert set(found.loops["seed"]) == {0, 1}
    assert set(found.new_sequences["seed"]) == {0}


def test_a_run_without_a_slow_level_has_an_empty_map(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    without_map(folder)
    assert collect(tmp_path).slow_state_map.empty


def test_other_folders_are_left_alone(tmp_path, make_run):
    make_run(tmp_path, TD_MD, 0)
    (tmp_path / "TD-MD" / "seed-old").mkdir()
    (tmp_path / "TD-MD" / "seed-1").write_text("a file")
    assert len(collect(tmp_path).runs) == 1


def test_no_folder(tmp_path):
    with pytest.raises(RunFolderError, match="there is no such run folder"):
        collect(tmp_path / "nowhere")


def test_no_ended_run(tmp_path, make_run):
    write_settings(tmp_path)
    with pytest.raises(RunFolderError, match="no ended run in it; runs lie in folders such as"):
        collect(tmp_path)
    make_run(tmp_path, CONDITIONS[0], 0, end="unfinished")
    with pytest.raises(RunFolderError, match="no ended run in it; 1 were begun"):
        collect(tmp_path)


TABLES = [f"{name}.csv" for name in LEADING_COLUMNS]


@pytest.mark.parametrize("name", [*TABLES, "inside.npz"])
def test_a_lost_file(tmp_path, make_run, name):
    path = make_run(tmp_path, TD_MD, 0) / name
    path.unlink()
    with pytest.raises(RunFolderError) as caught:
        collect(tmp_path)
    again = "the same `motionese reproduce` command writes the tables again from the checkpoints"
    assert str(caught.value) == f"{path} is missing: remove ended.json beside it, and {again}"


@given(data=st.data())
def test_any_byte_that_changed_is_told(eight_seeds, data):
    folder = eight_seeds / "TND-MD" / "seed-3"
    files = sorted(path for path in folder.iterdir() if path.stat().st_size)
    path = data.draw(st.sampled_from(files))
    whole = path.read_bytes()
    place = data.draw(st.integers(0, len(whole) - 1))
    other = data.draw(st.integers(0, 255).filter(lambda byte: byte != whole[place]))
    path.write_bytes(whole[:place] + bytes([other]) + whole[place + 1 :])
    try:
        with pytest.raises(RunFolderError) as caught:
            collect(eight_seeds)
    finally:
        path.write_bytes(whole)
    assert f"{path} has changed since it was written: remove " in str(caught.value)


def test_inside(tmp_path, make_run):
    make_run(tmp_path, TD_MD, 0)
    found = collect(tmp_path)
    arrays = found.inside("TD/MD", 0)
    assert arrays is not None and arrays["activity"].shape == (42, 48)
    make_run(tmp_path, TD_MD, 1, end="diverged")
    assert found.inside("TD/MD", 1) is None


def test_settings_of_the_folder(eight_seeds):
    facts = read_facts(eight_seeds)
    assert facts.study.network.gain == 3.25
    assert facts.record["preset"] == "<mine>"
    assert facts.environment["jax"] == "0.9"


def test_a_folder_that_tells_no_settings_is_none(tmp_path):
    with pytest.raises(RunFolderError, match=r"is no run folder: it has no settings\.json"):
        read_facts(tmp_path)
    write_settings(tmp_path)
    assert read_facts(tmp_path).environment == {}


@pytest.mark.parametrize("text", ["{", "[1]", "7", "[[1, 2]]"])
def test_broken_facts(tmp_path, text):
    write_settings(tmp_path)
    (tmp_path / "environment.json").write_text(text)
    list_anew(tmp_path)
    with pytest.raises(RunFolderError, match=r"environment\.json: not a JSON object"):
        read_facts(tmp_path)


OURS = {"format": "motionese-run", "version": 5}


@pytest.mark.parametrize(
    ("record", "told"),
    [
        (OURS | {"settings": {"phases": 3}}, r"does not fit this version .* phases is of the form"),
        (OURS | {"settings": {"curriculum": {}}}, r"does not fit this version .* is missing"),
        (OURS | {"settings": [1]}, "holds no settings"),
        (OURS, "holds no settings"),
        (OURS | {"version": 9}, "run folder of format 9"),
        ({"a": 1}, "was not written by motionese"),
        ([1], "was not written by motionese"),
    ],
)
def test_settings_of_another_schema_are_told_before_runs_are_looked_for(tmp_path, record, told):
    (tmp_path / "settings.json").write_text(json.dumps(record))
    with pytest.raises(RunFolderError, match=told):
        collect(tmp_path)


def test_flat():
    table = {"a": {"b": {"c": 1.5}, "d": True}, "e": [1, "x"], "f": None, "g": {}}
    assert dict(flat(table)) == {"a.b.c": "1.5", "a.d": "yes", "e": "1, x", "f": "–", "g": "–"}
