"""Keeping results, and reading what is kept."""

import json

import pandas as pd
import pytest
from invented_results import measures_table, write_reported
from invented_runs import STUDY, list_anew

from motionese.analysis import keep, kept_results
from motionese.analysis.kept import kept_runs
from motionese.errors import RunFolderError
from motionese.experiment import read_settings


@pytest.fixture
def results(tmp_path, monkeypatch):
    monkeypatch.setattr("motionese.analysis.kept.RESULTS", tmp_path / "results")
    return tmp_path / "results"


def test_what_is_kept_is_read_again(tmp_path, results):
    measured = measures_table(range(1000, 1003), level=1 / 3, without=["order_by_cs"])
    order = write_reported(tmp_path / "runs" / "a", measured)
    mine = write_reported(tmp_path / "runs" / "b", measured, preset="taken/from/mine.toml")
    keep([order, mine], results)
    assert {path.name for path in results.iterdir()} == {"mine.csv", "order.csv", "runs.json"}
    kept = kept_results()
    assert list(kept) == ["order", "mine"]
    pd.testing.assert_frame_equal(kept["order"], measured, rtol=1e-5)
    runs = kept_runs()["order"]
    assert (runs.seeds, runs.version) == ([1000, 1001, 1002], "0.7")
    assert runs.settings == STUDY.model_dump(mode="json")


def test_the_same_runs_are_kept_as_the_same_bytes(tmp_path, results):
    order = write_reported(tmp_path / "order", measures_table(range(3)))
    keep([order], results)
    first = {path.name: path.read_bytes() for path in results.iterdir()}
    keep([order], results)
    assert {path.name: path.read_bytes() for path in results.iterdir()} == first


def test_where_nothing_is_kept_there_is_nothing(results):
    assert kept_results() == {} and kept_runs() == {}


def test_what_comes_with_the_package_is_whole():
    tables, runs = kept_results(), kept_runs()
    assert tables.keys() == runs.keys() <= {"default", "order", "free"}
    for preset, table in tables.items():
        assert sorted(set(table["seed"])) == runs[preset].seeds == list(range(1000, 1030))
        assert set(table["condition"]) <= {c.name for c in read_settings(preset).conditions}


def refused(folders, results):
    with pytest.raises(RunFolderError) as caught:
        keep(folders, results)
    assert not results.exists()
    return str(caught.value)


def test_what_cannot_be_kept_is_refused_and_nothing_is_written(tmp_path, results):
    table = measures_table(range(2))
    order = write_reported(tmp_path / "order", table)
    again = write_reported(tmp_path / "again", table)
    ends = {("TD/MD", 5): "unfinished"}
    begun = write_reported(tmp_path / "begun", table, preset="free", ends=ends)
    assert "again is of order, as " in refused([order, again], results)
    assert "begun holds runs that have not ended" in refused([order, begun], results)
    (again / "measures.csv").unlink()
    assert "again writes it" in refused([again], results)
    (again / "measures.csv").write_text("condition,seed,separation\nTD/MD,0,high\n")
    list_anew(again)
    assert "again has no whole report" in refused([again], results)
    (again / "settings.json").write_text(json.dumps({}))
    list_anew(again)
    assert "was not written by motionese" in refused([again], results)
