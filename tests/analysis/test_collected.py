"""Putting run folders together: order, failures, missing pieces."""

import json

import pandas as pd
import pytest

from motionese.analysis.collected import LEADING_COLUMNS, collect
from motionese.analysis.facts import flat, read_facts
from motionese.errors import RunFolderError, SettingError
from motionese.experiment.conditions import CONDITIONS, condition

TD_MD, TND_MND = condition("TD/MD"), condition("TND/MND")


def test_rows_are_in_the_order_of_conditions_and_seeds(tmp_path, make_run):
    for seed in (10, 9, 100):
        make_run(tmp_path, TND_MND, seed)
        make_run(tmp_path, TD_MD, seed)
    found = collect(tmp_path)
    order = found.loops[["condition", "seed"]].drop_duplicates().to_numpy().tolist()
    assert order == [[c, s] for c in ("TD/MD", "TND/MND") for s in (9, 10, 100)]
    assert found.conditions == (TD_MD, TND_MND)
    for name, columns in LEADING_COLUMNS.items():
        assert list(getattr(found, name).columns)[: len(columns)] == columns


def test_numbers_survive_to_the_last_bit(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    exact = 0.1 + 0.2
    table = pd.read_csv(folder / "loops.csv").assign(imitation_error_cm=exact)
    table.to_csv(folder / "loops.csv", index=False)
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
    assert set(found.triples["seed"]) == {0}


def test_a_run_without_a_slow_level_has_an_empty_map(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    (folder / "slow_state_map.csv").write_text("\n")
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
    with pytest.raises(RunFolderError, match="no ended run in it; runs lie in folders such as"):
        collect(tmp_path)
    make_run(tmp_path, CONDITIONS[0], 0, end="unfinished")
    with pytest.raises(RunFolderError, match="no ended run in it; 1 were begun"):
        collect(tmp_path)


def test_a_lost_table(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    (folder / "loops.csv").unlink()
    with pytest.raises(RunFolderError, match=r"loops\.csv is missing"):
        collect(tmp_path)


def test_inside(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    found = collect(tmp_path)
    arrays = found.inside(TD_MD, 0)
    assert arrays is not None and arrays["activity"].shape == (42, 48)
    (folder / "inside.npz").unlink()
    assert found.inside(TD_MD, 0) is None


def test_settings_of_the_folder(eight_seeds):
    facts = read_facts(eight_seeds)
    assert facts.told and facts.settings.network.gain == 3.25
    assert facts.record["preset"] == "<mine>"
    assert facts.environment["jax"] == "0.9"


def test_a_folder_that_tells_nothing(tmp_path):
    facts = read_facts(tmp_path)
    assert not facts.told and facts.environment == {}
    assert facts.settings.network.gain == 4.0


def test_broken_facts(tmp_path):
    (tmp_path / "environment.json").write_text("{")
    with pytest.raises(RunFolderError, match="not a JSON object"):
        read_facts(tmp_path)
    (tmp_path / "settings.json").write_text(json.dumps({"settings": {"phases": 3}}))
    with pytest.raises(SettingError, match="phases"):
        read_facts(tmp_path)


def test_flat():
    table = {"a": {"b": {"c": 1.5}, "d": True}, "e": [1, "x"], "f": None, "g": {}}
    assert dict(flat(table)) == {"a.b.c": "1.5", "a.d": "yes", "e": "1, x", "f": "–", "g": "–"}
