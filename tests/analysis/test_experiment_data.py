"""Putting run folders together: order, failures, missing pieces."""

import json

import numpy as np
import pandas as pd
import pytest
from invented_runs import CONDITIONS, STUDY, condition, without_map, write_end, write_settings

from motionese.analysis.experiment_data import collect, leading_columns
from motionese.analysis.facts import flat, read_facts
from motionese.errors import RunFolderError, StorageError

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


def refused(folder, file, told):
    with pytest.raises(RunFolderError) as caught:
        collect(folder.parents[1])
    sentence = str(caught.value)
    assert file in sentence and told in sentence and "\n" not in sentence
    assert "remove ended.json beside it, and the same `motionese reproduce` command" in sentence


def without_row_counts(folder):
    path = folder / "ended.json"
    ended = json.loads(path.read_text())
    del ended["rows"]
    path.write_text(json.dumps(ended))


TABLES = pytest.mark.parametrize("name", LEADING_COLUMNS)


@TABLES
def test_a_lost_table(tmp_path, make_run, name):
    folder = make_run(tmp_path, TD_MD, 0)
    (folder / f"{name}.csv").unlink()
    refused(folder, f"{name}.csv", "is missing")


@TABLES
@pytest.mark.parametrize("counted", [True, False])
@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (lambda whole: b"", "empty"),
        (lambda whole: whole[: whole.index(b",", len(whole) // 2)], "cut short"),
        (lambda whole: whole[:-1], "cut short"),
        (lambda whole: b"\x00\xff\xfe\x93" * 50, "not a text"),
        (lambda whole: whole + b"stray\n", "columns"),
        (lambda whole: whole + b"\n", "columns"),
        (lambda whole: whole.replace(b"\n", b",1,2\n").replace(b",1,2\n", b"\n", 1), "columns"),
        (lambda whole: whole[: whole.index(b"\n") + 1], "no rows"),
        (lambda whole: whole.replace(b"seed", b"sead", 1), "no column seed"),
        (lambda whole: whole.replace(b"TD/MD,0,", b"TD/MD,x,", 1), "not every seed"),
        (lambda whole: whole.replace(b"TD/MD,0,", b"TD/MD,7,", 1), "rows of another run"),
        (lambda whole: whole.replace(b"TD/MD", b'"TD/MD', 1), "damaged"),
    ],
)
def test_a_damaged_table(tmp_path, make_run, name, counted, damage, told):
    folder = make_run(tmp_path, TD_MD, 0)
    path = folder / f"{name}.csv"
    path.write_bytes(damage(path.read_bytes()))
    if not counted:
        without_row_counts(folder)
    refused(folder, path.name, told)


@TABLES
def test_a_table_that_lost_whole_lines(tmp_path, make_run, name):
    folder = make_run(tmp_path, TD_MD, 0)
    path = folder / f"{name}.csv"
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(lines[:-1]))
    refused(folder, path.name, f"{len(lines) - 2} rows of {len(lines) - 1}")


def test_a_stray_quote_does_not_swallow_rows(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    without_row_counts(folder)
    path = folder / "loops.csv"
    table = pd.read_csv(path)
    table = table[[*table.columns.drop("press_depths_mm"), "press_depths_mm"]]
    head, first, second, *others = table.to_csv(index=False).splitlines(keepends=True)
    second = ',"'.join(second.rsplit(",", 1))
    path.write_text("".join([head, first, second, *others]))
    refused(folder, "loops.csv", "damaged")


def test_a_map_of_no_points_where_there_were_some(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    (folder / "slow_state_map.csv").write_text("\n")
    refused(folder, "slow_state_map.csv", "0 rows of")


@pytest.mark.parametrize(
    ("name", "column", "value"),
    [
        ("loops", "imitation_error_cm", "4..2"),
        ("loops", "loop", None),
        ("loops", "motion", None),
        ("triples", "trained", "Fals"),
        ("development", "rms_cs_to_cf", "?"),
        ("slow_state_map", "direction_2_rad", "east"),
    ],
)
def test_a_cell_that_is_not_what_its_column_holds(tmp_path, make_run, name, column, value):
    folder = make_run(tmp_path, TD_MD, 0)
    path = folder / f"{name}.csv"
    table = pd.read_csv(path).astype({column: object})
    table.loc[1, column] = value
    table.to_csv(path, index=False)
    refused(folder, path.name, f"not every {column} is one")


def test_runs_of_before_rows_were_counted(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    counted = collect(tmp_path)
    without_row_counts(folder)
    pd.testing.assert_frame_equal(collect(tmp_path).loops, counted.loops)


@pytest.mark.parametrize("text", ["[1]", "7", "{}", "null", "{", '{"reason": ""}', "\x00"])
def test_an_end_that_tells_no_status(tmp_path, make_run, text):
    folder = make_run(tmp_path, TD_MD, 0)
    (folder / "ended.json").write_text(text)
    with pytest.raises((RunFolderError, StorageError), match=r"ended\.json.*remove it"):
        collect(tmp_path)


@pytest.mark.parametrize("wrong", [{"status": 3}, {"seconds": "long"}, {"rows": [1]}])
def test_an_end_of_another_shape(tmp_path, make_run, wrong):
    write_end(make_run(tmp_path, TD_MD, 0), wrong)
    with pytest.raises(RunFolderError, match=r"ended\.json does not tell how .* remove it"):
        collect(tmp_path)


@pytest.mark.parametrize(
    "damage",
    [
        lambda whole: b"",
        lambda whole: whole[: len(whole) // 2],
        lambda whole: whole[:100] + bytes(100) + whole[200:],
        lambda whole: b"\x93NUMPY garbage",
        lambda whole: b"no archive at all",
    ],
)
def test_damaged_performances(tmp_path, make_run, damage):
    path = make_run(tmp_path, TD_MD, 0) / "inside.npz"
    path.write_bytes(damage(path.read_bytes()))
    with pytest.raises(RunFolderError, match=r"inside\.npz is damaged .*remove ended\.json"):
        collect(tmp_path).inside("TD/MD", 0)


def test_performances_that_lack_an_array(tmp_path, make_run):
    path = make_run(tmp_path, TD_MD, 0) / "inside.npz"
    np.savez(path, activity=np.zeros((2, 2)))
    with pytest.raises(RunFolderError, match=r"no commanded, sensed, begins, poses"):
        collect(tmp_path).inside("TD/MD", 0)


def test_inside(tmp_path, make_run):
    folder = make_run(tmp_path, TD_MD, 0)
    found = collect(tmp_path)
    arrays = found.inside("TD/MD", 0)
    assert arrays is not None and arrays["activity"].shape == (42, 48)
    (folder / "inside.npz").unlink()
    assert found.inside("TD/MD", 0) is None


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
    with pytest.raises(RunFolderError, match=r"environment\.json: not a JSON object"):
        read_facts(tmp_path)


OURS = {"format": "motionese-run", "version": 4}


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
