"""The results in a few lines, and of which run folders a report is written."""

import io
from pathlib import Path

import pandas as pd
import pytest
from invented_runs import condition, write_run, write_settings
from rich.console import Console

from motionese.experiment import read_settings
from motionese.interfaces.commands import results as module
from motionese.interfaces.commands.results import summary


@pytest.fixture
def folder(tmp_path):
    rows = [
        {
            "condition": condition,
            "seed": seed,
            "loop": loop,
            "phase": 1 if loop <= 2 else 2,
            "imitation_error_cm": error + 10 * seed / loop + spread,
            "buttons_due": 2,
            "buttons_pressed": 1,
        }
        for condition, error in (("TD/MD", 1.0), ("TND/MND", 2.0))
        for seed in (0, 1, 5)
        for loop in (1, 2, 4)
        for spread in (-0.5, 0.5)
    ]
    pd.DataFrame(rows).to_csv(tmp_path / "loops.csv")
    new = [
        {"condition": "TD/MD", "seed": seed, "trained": trained, "imitation_error_cm": error}
        for seed in (0, 1, 5)
        for trained, error in ((True, 90.0), (False, 3.0 + seed))
    ]
    pd.DataFrame(new).to_csv(tmp_path / "triples.csv")
    return tmp_path


def lines(table):
    out = io.StringIO()
    Console(file=out, width=120).print(table)
    return [
        [cell.strip() for cell in line.split("│")[1:-1]] for line in out.getvalue().splitlines()
    ]


def test_medians_over_seeds_of_means_over_motions_and_of_untaught_sequences_alone(folder):
    assert lines(summary(folder, read_settings()))[5:-1] == [
        ["TD/MD", "3", "11.0", "6.0", "3.5", "4.0", "6 of 12"],
        ["TND/MND", "3", "12.0", "7.0", "4.5", "–", "6 of 12"],
    ]


def test_every_stage_of_a_study_has_a_column_and_every_set_of_new_sequences(folder):
    headers = [
        str(column.header) for column in summary(folder, read_settings("three_stages")).columns
    ]
    assert headers[2:-1] == ["loop 1", "stage 1", "stage 2", "stage 3", "new triples"]


def test_without_new_sequences_there_is_no_column_and_without_due_presses_a_dash(folder):
    (folder / "triples.csv").unlink()
    loops = pd.read_csv(folder / "loops.csv").assign(buttons_due=0, buttons_pressed=0)
    loops.to_csv(folder / "loops.csv")
    assert lines(summary(folder, read_settings()))[5] == ["TD/MD", "3", "11.0", "6.0", "3.5", "–"]


@pytest.fixture
def reported(here, monkeypatch):
    """Empty run folders, and of which ones a report is asked for."""
    for folder in ("runs/a", "runs/b", "else/c", "x"):
        (here / folder).mkdir(parents=True)
        write_settings(here / folder)
    asked = []

    def results(folder, console):
        asked.append(folder)
        return ""

    def all_results(folders, path, console):
        asked.append((folders, path))
        return ""

    monkeypatch.setattr(module, "write_results", results)
    monkeypatch.setattr(module, "write_all_results", all_results)
    return asked


A, B, C = Path("runs/a"), Path("runs/b"), Path("else/c")


@pytest.mark.parametrize(
    ("arguments", "asked"),
    [
        (["runs/a"], A),
        (["runs"], ([A, B], Path("runs/report.html"))),
        (["runs/b", "runs/a"], ([B, A], Path("runs/report.html"))),
        (["runs/a", "--out", "one.html"], ([A], Path("one.html"))),
        (["runs", "else/c", "--out", "all.html"], ([A, B, C], Path("all.html"))),
        (["else"], ([C], Path("else/report.html"))),
    ],
)
def test_a_run_folder_has_its_report_and_several_have_one_more(command, reported, arguments, asked):
    status, _, errors = command("report", *arguments)
    assert (status, errors, reported) == (0, "", [asked])


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["runs/a", "else/c"], "these run folders do not lie in one folder; say with --out FILE"),
        (["runs/a", "nowhere"], "nowhere is no run folder: there is no such folder"),
    ],
)
def test_folders_that_no_one_report_can_be_written_of(command, reported, arguments, told):
    status, output, errors = command("report", *arguments)
    assert (status, output, reported) == (2, "", [])
    assert errors.startswith(f"motionese: {told}")


@pytest.mark.parametrize(
    ("out", "told"),
    [("runs", "runs is a folder"), ("runs/a/all.html", "runs/a/all.html would lie in a run fold")],
)
def test_places_that_are_none_for_the_one_report(command, here, out, told):
    (here / "runs" / "a").mkdir(parents=True)
    write_settings(here / "runs" / "a")
    status, output, errors = command("report", "runs/a", "--out", out)
    assert (status, output) == (2, "")
    assert errors.startswith(f"motionese: {told}")


@pytest.mark.slow
def test_the_one_report_of_run_folders_is_made_of_what_theirs_leave(command, here, monkeypatch):
    monkeypatch.setattr("motionese.analysis.report.figures", lambda *of: ())
    for preset in ("default", "order"):
        study = read_settings(preset)
        for seed in (0, 1):
            (here / "runs" / preset).mkdir(parents=True, exist_ok=True)
            write_settings(here / "runs" / preset, study, preset=preset)
            write_run(here / "runs" / preset, condition("TD/MD"), seed, study=study)
    status, output, errors = command("report", "runs")
    assert (status, errors) == (0, "")
    told = [line for line in output.splitlines() if "runs/" in line]
    assert told == [
        *("runs/default:", "Report: runs/default/report.html"),
        *("runs/order:", "Report: runs/order/report.html", "Report of all: runs/report.html"),
    ]
    beside = pd.read_csv(here / "runs" / "beside_kept.csv")
    own = beside[(beside["measure"] == "separation") & beside["median"].notna()]
    (separation,) = own.to_dict("records")
    assert (separation["runs"], separation["median"], separation["seeds"]) == ("order", 1.0, 2)
    page = (here / "runs" / "report.html").read_text()
    assert "default with 2 seeds (0–1) and order with 2 seeds (0–1)" in page
