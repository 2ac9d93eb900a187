"""The whole report on invented runs: complete, self-contained, the same every time."""

import re
import shutil

import numpy as np
import pandas as pd
import pytest
from invented_runs import STUDY, condition, list_anew, without_map, without_stage_2, write_settings
from report_page import Page

from motionese.analysis import write_report
from motionese.analysis.experiment_data import ROLES, collect
from motionese.analysis.reported import read_reported
from motionese.errors import RenderingError, RunFolderError
from motionese.experiment import Study
from motionese.experiment.digests import changed

TD_MD, TND_MD = condition("TD/MD"), condition("TND/MD")
TABLES = [
    "loops",
    "development",
    "triples",
    "slow_state_map",
    "map_numbers",
    "claims",
    "effects",
    "runs",
    *ROLES,
    "measures",
]


@pytest.fixture(scope="module")
def no_gl():
    with pytest.MonkeyPatch.context() as patch:

        def refuse(model, poses, **_):
            raise RenderingError("no GL here")

        patch.setattr("motionese.analysis.film.pictures", refuse)
        yield


@pytest.fixture(scope="module")
def whole(eight_seeds, tmp_path_factory, no_gl):
    folder = tmp_path_factory.mktemp("whole") / "mine"
    shutil.copytree(eight_seeds, folder)
    report = write_report(folder)
    return folder, report, Page(report.path.read_text())


def test_report_and_tables_are_there(whole):
    folder, report, _ = whole
    assert report.path == folder / "report.html"
    assert report.runs == 32 and report.too_few == ""
    for name in TABLES:
        assert len(pd.read_csv(folder / f"{name}.csv"))
    figures = {path.stem for path in (folder / "figures").glob("*.svg")}
    assert figures == {path.stem for path in (folder / "figures").glob("*.png")}
    assert figures >= {"learning_curves", "new_sequences", "slow_state_map_1", "inside", "film"}
    assert figures >= {"who_is_followed", "lesions", "symbols"}
    assert not list(folder.rglob("*.part"))


def test_the_page_fetches_nothing(whole):
    text, page = whole[1].path.read_text(), whole[2]
    assert page.resources
    for resource in page.resources:
        assert resource.startswith(("#", "data:"))
    assert not re.findall(r"url\((?!#)", text)
    assert "@import" not in text and "<script" not in text
    outside = set(re.findall(r"https?://[^\"'\s<)]+", text))
    assert outside <= {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"}


def test_names_on_the_page_are_unique_and_links_lead_somewhere(whole):
    page = whole[2]
    assert len(set(page.ids)) == len(page.ids)
    for resource in page.resources:
        if resource.startswith("#"):
            assert resource[1:] in page.ids


def test_the_page_tells_what_was_computed(whole):
    text = whole[2].text
    assert "Runs took different numbers of loops" not in text
    assert "When do clear primitives emerge" in text
    assert "yes in TD/MD (1.00); no in TD/MND" in text
    assert "best of all: holds" in text
    assert "network.gain 3.25" in text
    assert "<mine>" in text, "what users wrote is shown, not taken for tags"
    assert "All runs finished" in text
    assert "Drawn from the side" in text and "no GL here" in text
    assert "Efference copy." in text
    assert "2 all conditions taught pairs 0.00 0.00 0.00 0 0.0 this lesson asks for no" in text
    assert "0, 1, 2, 3, 4, 5, 6, 7" in text


def test_what_was_planned_is_not_asked_of_runs_of_other_settings(whole):
    folder, _, page = whole
    assert not (folder / "findings.csv").exists() and "planned to be tested" not in page.text


def test_a_lesson_that_asks_for_no_order_is_said_to_be_one(whole):
    text = whole[2].text
    assert "it asks for no memory of order, and of order there is nothing to exchange" in text
    assert "exchange: first stroke follows Cf₀ 1.00 [1.00, 1.00]" in text
    assert "exchange: order" not in text
    assert "True by construction" in text and "all motions share one Cf₀" in text


@pytest.mark.slow
def test_runs_of_the_plan(orderly, tmp_path, unrendered):
    folder = tmp_path / "orderly"
    shutil.copytree(orderly, folder)
    page = Page(write_report(folder).path.read_text())
    assert "Where the lesson asks for memory of order, whether clear primitives" in page.text
    assert "is undecided with 3 seeds" in page.text and "nothing to exchange" not in page.text
    assert "Separation: Only TD/MD separates the roles" in page.text
    assert "hardly moved" not in page.text.partition("Planned tests")[0]
    found = pd.read_csv(folder / "findings.csv")
    assert set(found["family"]) == {"Separation", "Generalisation"}
    assert len(pd.read_csv(folder / "measures.csv")) == 12
    for name in ("who_is_followed", "lesions", "symbols", "recall", "order_map", "order_decoded"):
        assert name in page.ids and (folder / "figures" / f"{name}.png").is_file()


def test_claims_table_beside_the_page(whole):
    claims = pd.read_csv(whole[0] / "claims.csv")
    assert set(claims["verdict"]) <= {"holds", "does not hold", "undecided with 8 seeds"}
    assert (claims.loc[claims["claim"].str.startswith("(a)"), "verdict"] == "holds").all()


@pytest.mark.slow
def test_some_conditions_with_failures(tmp_path, make_run, unrendered):
    for seed in range(2):
        make_run(tmp_path, TD_MD, seed)
        make_run(tmp_path, TND_MD, seed, end="diverged" if seed else "finished")
    make_run(tmp_path, TD_MD, 5, end="unfinished")
    report = write_report(tmp_path)
    page = Page(report.path.read_text())
    assert report.runs == 4 and report.too_few == ""
    assert "2 of the runs did not finish" in page.text
    assert "loop 2: diverged at epoch 3" in page.text and "stopped after loop 2" in page.text
    assert "undecided with 0 seeds" in page.text and "TND/MND (1" not in page.text


@pytest.mark.slow
def test_one_seed_and_again_the_same_bytes(tmp_path, make_run, unrendered):
    make_run(tmp_path, TD_MD, 7)
    make_run(tmp_path, TND_MD, 7)
    report = write_report(tmp_path)
    assert report.too_few == (
        "a test over seeds needs at least 2 of them; with an ended run in TD/MD and TND/MD: got 1"
    )
    page = Page(report.path.read_text())
    assert report.too_few in page.text
    assert "undecided with 1 seed" in page.text
    claims = pd.read_csv(tmp_path / "claims.csv")
    assert set(claims["verdict"]) == {"undecided with 0 seeds", "undecided with 1 seed"}
    assert claims["p"].isna().all()
    first = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    write_report(tmp_path)
    second = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    assert first.keys() == second.keys()
    assert [path for path in first if first[path] != second[path]] == []


@pytest.mark.slow
def test_nothing_but_a_diverged_run(tmp_path, make_run):
    make_run(tmp_path, TD_MD, 0, end="diverged")
    report = write_report(tmp_path)
    page = Page(report.path.read_text())
    assert report.runs == 1 and report.too_few
    assert "No run was evaluated on new sequences" in page.text
    assert "No run that ended has a slow level" in page.text
    assert "Nothing was kept of a performance" in page.text
    make_run(tmp_path, TD_MD, 1, end="diverged")
    assert write_report(tmp_path).runs == 2


@pytest.mark.slow
def test_a_network_without_a_slow_level(tmp_path, make_run, unrendered):
    folder = make_run(tmp_path, TD_MD, 0)
    without_map(folder)
    page = Page(write_report(tmp_path).path.read_text())
    assert "no slow level, no map" in page.text


@pytest.mark.slow
def test_one_stage_is_all(tmp_path, make_run, unrendered):
    table = STUDY.model_dump(mode="json")
    write_settings(tmp_path, Study.model_validate(table | {"stages": table["stages"][:1]}))
    for seed in range(2):
        without_stage_2(make_run(tmp_path, TD_MD, seed))
    report = write_report(tmp_path)
    assert report.too_few == ""
    assert not (tmp_path / "claims.csv").exists(), "the paper's claims are about two stages"
    text = report.path.read_text()
    assert "end of stage 1" in text and "end of stage 2" not in text
    assert "The paper’s claims" not in text and "What was learned of pushing two buttons?" in text


@pytest.mark.slow
def test_stages_that_ended_after_different_numbers_of_loops(tmp_path, make_run, unrendered):
    for seed in range(2):
        table = make_run(tmp_path, TD_MD, seed) / "loops.csv"
    loops = pd.read_csv(table)
    ended = loops.loc[loops["phase"] == 1, "loop"].max()
    shorter = loops[loops["loop"] != ended].assign(loop=lambda t: t["loop"] - (t["loop"] > ended))
    shorter.to_csv(table, index=False)
    list_anew(table.parent)
    page = Page(write_report(tmp_path).path.read_text())
    assert "Runs took different numbers of loops" in page.text


def test_verdicts_on_several_parts_are_explained(whole):
    assert "divided by the number of parts (Bonferroni)" in whole[2].text


def test_a_folder_that_cannot_be_written_to(tmp_path, make_run, monkeypatch):
    make_run(tmp_path, TD_MD, 0)

    def refuse(path, content):
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr("motionese.analysis.report.write_whole", refuse)
    with pytest.raises(RunFolderError, match=r"loops\.csv cannot be written: Permission denied"):
        write_report(tmp_path)


def test_no_run(tmp_path):
    with pytest.raises(RunFolderError, match=r"it has no settings\.json"):
        write_report(tmp_path)
    write_settings(tmp_path)
    with pytest.raises(RunFolderError, match="no ended run"):
        write_report(tmp_path)


@pytest.mark.slow
def test_of_200_files_with_a_byte_changed_or_cut_off_anywhere_200_are_told(
    tmp_path, make_run, unrendered
):
    for seed in (0, 1):
        make_run(tmp_path, TD_MD, seed)
    write_report(tmp_path)
    files = [path for path in sorted(tmp_path.rglob("*")) if path.is_file()]
    sizes = np.array([path.stat().st_size for path in files], dtype=float)
    rng, told = np.random.default_rng(0), 0
    for path in rng.choice(np.array(files), 200, p=sizes / sizes.sum()):
        whole = path.read_bytes()
        content, place = bytearray(whole), rng.integers(len(whole))
        content[place] ^= rng.integers(1, 256)
        path.write_bytes(content if rng.random() < 0.75 else whole[:place])
        try:
            collect(tmp_path)
            told += path in changed(tmp_path)  # and written anew
        except RunFolderError as error:
            told += f"{path} has changed since it was written" in str(error)
        path.write_bytes(whole)
    assert told == 200


@pytest.mark.slow
def test_what_had_changed_of_the_report_before_is_told_and_written_anew(
    tmp_path, make_run, unrendered
):
    make_run(tmp_path, TD_MD, 3)
    folder = tmp_path
    assert write_report(folder).unlike == []
    pictures = [folder / "figures" / "learning_curves.png", folder / "measures.csv"]
    before = [path.read_bytes() for path in pictures]
    for path, content in zip(pictures, before, strict=True):
        path.write_bytes(content[:50] + b"!" + content[51:])
    with pytest.raises(RunFolderError, match=r"measures\.csv has changed .* writes it again"):
        read_reported(folder)
    assert sorted(write_report(folder).unlike) == pictures
    assert [path.read_bytes() for path in pictures] == before
    assert read_reported(folder).seeds == [3]
