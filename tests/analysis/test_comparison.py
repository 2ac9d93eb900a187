"""One report for several run folders: what is kept first, and these runs beside it."""

import json
import shutil

import pandas as pd
import pytest
from invented_results import measures_table, write_reported
from report_page import Page

from motionese.analysis import keep, write_comparison
from motionese.analysis.beside_kept import TITLES
from motionese.errors import RunFolderError
from motionese.experiment import read_settings

ORDER, DEFAULT = read_settings("order"), read_settings("default")


def two_presets(root, seeds, level=0.5, ends=()):
    """Write run folders of both presets; that of the paper's lesson asks for no order."""
    lacking = measures_table(seeds, level, without=["order_by_cs", "separation"])
    measured = measures_table(seeds, level)
    if len(seeds) == 3:
        measured.loc[measured["condition"] == "TND/MD", "separation"] = 0.1
    return [
        write_reported(root / "order", measured, ORDER, ends=ends),
        write_reported(root / "default", lacking, DEFAULT, "default"),
    ]


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """Where thirty seeds of both presets are kept."""
    root = tmp_path_factory.mktemp("kept")
    keep(two_presets(root, range(1000, 1030)), root / "results")
    return root / "results"


@pytest.fixture
def kept(results, monkeypatch):
    monkeypatch.setattr("motionese.analysis.kept.RESULTS", results)


@pytest.fixture
def nothing_kept(tmp_path, monkeypatch):
    monkeypatch.setattr("motionese.analysis.kept.RESULTS", tmp_path / "results")


@pytest.fixture(scope="module")
def own(tmp_path_factory, results):
    """Three seeds of each preset and their one report; in one condition the separation is low."""
    root = tmp_path_factory.mktemp("own")
    folders = two_presets(root, range(3), level=0.6, ends={("TD/MND", 1): "diverged"})
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("motionese.analysis.kept.RESULTS", results)
        write_comparison(folders, root / "report.html")
    return root


@pytest.fixture
def page(own):
    return Page((own / "report.html").read_text())


def written(folders, path):
    write_comparison(folders, path)
    return Page(path.read_text())


def test_the_kept_runs_answer_and_these_stand_beside_them(page):
    told = "What the kept runs say: order with 30 seeds (1000–1029) and default with 30 seeds"
    assert told in page.text and "made once with motionese 0.7" in page.text
    assert "Your own runs: order with 3 seeds (0–2) and default with 3 seeds (0–2)." in page.text
    assert "Fewer than 6 seeds decide nothing." in page.text
    outside = f"{TITLES['separation']}, TND/MD (0.10; usual 0.51–0.78)."
    assert f"medians lie outside: {outside}" in page.text
    assert page.text.count("outside 0.51–0.78") == 1
    assert "default: all " in page.text and "medians lie inside." in page.text
    assert "Of these 12 runs 1 diverged; see Runs." in page.text
    assert "order, TD/MND 1 diverged loop 2: diverged" in page.text
    assert "other settings" not in page.text


def test_the_page_needs_nothing_else_and_leads_to_the_full_reports(page):
    leading = [each for each in page.resources if not each.startswith(("#", "data:"))]
    assert leading == ["order/report.html", "default/report.html"]
    assert len(set(page.ids)) == len(page.ids)
    assert {each[1:] for each in page.resources if each.startswith("#")} <= set(page.ids)


def test_its_table_and_figures_lie_beside_it(own):
    beside = pd.read_csv(own / "beside_kept.csv", keep_default_na=False)
    assert list(dict.fromkeys(beside["runs"])) == ["order", "default"]
    (row,) = beside[(beside["runs"] == "order") & (beside["place"] == "outside")].to_dict("records")
    assert (row["measure"], row["condition"], row["median"]) == ("separation", "TND/MD", 0.1)
    assert {path.name for path in (own / "figures").iterdir()} == {
        f"beside_kept_{number}.{ending}" for number in (1, 2) for ending in ("svg", "png")
    }


def test_the_same_runs_give_the_same_bytes_and_links_lead_to_them_from_elsewhere(
    kept, own, tmp_path
):
    page = written([own / "order", own / "default"], tmp_path / "some where" / "report.html")
    assert any(each.endswith("/order/report.html") for each in page.resources)
    for file in ("beside_kept.csv", "figures/beside_kept_1.svg", "figures/beside_kept_2.png"):
        assert (own / file).read_bytes() == (tmp_path / "some where" / file).read_bytes()


@pytest.mark.slow
def test_other_settings_and_other_presets_are_told(kept, tmp_path):
    measured = measures_table(range(8))
    slow = read_settings("order", ["network.levels.cs.tau=90"])
    folders = [
        write_reported(tmp_path / "own" / "slow", measured, slow),
        write_reported(tmp_path / "own" / "mine", measured, preset="my/own.toml"),
    ]
    page = written(folders, tmp_path / "own" / "report.html")
    told = "other settings than the kept ones (kept → yours): network.levels.cs.tau: 70.0 → 90.0."
    assert told in page.text
    assert "Nothing is kept of preset own: these runs stand alone." in page.text
    assert "decide nothing" not in page.text


@pytest.mark.slow
def test_where_nothing_is_kept_these_runs_are_all(nothing_kept, own, tmp_path):
    page = written([own / "order"], tmp_path / "report.html")
    assert "What these runs say; none are kept in this version of motionese" in page.text
    assert "Nothing stands beside them: what is said above is of them alone." in page.text
    assert "medians lie" not in page.text and "Medians over your seeds." in page.text


@pytest.mark.slow
def test_folders_of_one_name_are_told_apart_by_their_paths(nothing_kept, tmp_path):
    folders = [
        write_reported(tmp_path / name / "order", measures_table(range(2))) for name in ("a", "b")
    ]
    page = written(folders, tmp_path / "report.html")
    assert f"{tmp_path / 'a' / 'order'} with 2 seeds (0–1)" in page.text


def test_runs_of_which_nothing_was_measured(kept, tmp_path):
    none = measures_table([0]).iloc[:0]
    ends = {("TD/MD", 0): "unfinished"}
    folder = write_reported(tmp_path / "own" / "free", none, preset="free", ends=ends)
    page = written([folder], tmp_path / "own" / "report.html")
    assert "Your own runs: free with no seed." in page.text
    assert "Of these 1 runs 1 did not end" in page.text


def test_a_folder_without_a_report_is_refused(kept, tmp_path):
    folder = write_reported(tmp_path / "own" / "free", measures_table([0]))
    (folder / "runs.csv").unlink()
    with pytest.raises(
        RunFolderError, match=r"runs\.csv is missing; motionese report .* writes it again"
    ):
        write_comparison([folder], tmp_path / "report.html")
    assert not (tmp_path / "report.html").exists()


def test_where_it_cannot_be_written_is_told(kept, own, tmp_path):
    (tmp_path / "file").touch()
    with pytest.raises(RunFolderError, match="file cannot be written: File exists"):
        write_comparison([own / "order"], tmp_path / "file" / "report.html")


@pytest.mark.slow
def test_what_was_no_setting_yet_is_told_only_where_it_is_used(results, tmp_path, monkeypatch):
    older = tmp_path / "older"
    shutil.copytree(results, older)
    facts = json.loads((older / "runs.json").read_text())
    del facts["order"]["settings"]["caregiver"]["motionese"]
    (older / "runs.json").write_text(json.dumps(facts))
    monkeypatch.setattr("motionese.analysis.kept.RESULTS", older)
    measured = measures_table(range(3))
    paused = read_settings("order", ["caregiver.motionese.pauses.strength=1"])

    plain = write_reported(tmp_path / "own" / "plain", measured, ORDER)
    assert "other settings" not in written([plain], tmp_path / "own" / "plain.html").text
    other = write_reported(tmp_path / "own" / "paused", measured, paused)
    told = "(kept → yours): caregiver.motionese.pauses.strength: 0.0 → 1.0."
    assert told in written([other], tmp_path / "own" / "paused.html").text
