"""What the command says and returns when runs diverge, cannot go on, or are too few to test."""

import json
from pathlib import Path

import pytest
from invented_runs import write_settings
from small_runs import SMALL

from motionese.experiment import read_settings
from motionese.experiment.digests import list_files
from motionese.experiment.presets import preset_text
from motionese.experiment.run_folder import open_run_folder
from motionese.interfaces.commands import reproduce as module

COMMAND = ["reproduce", "--seeds", "2", "--conditions", "TD/MD", "--out", "out", "--set", *SMALL]


@pytest.fixture
def pretend(monkeypatch):
    """Let every run end with a status, or not at all, and the report find too few seeds."""

    def pretended(status="finished", failures=(), too_few=""):
        reported = []

        def go_through_all(jobs, workers, *, loop_done, run_ended):
            for job in jobs:
                assert job.recordings is None, "scripted ones"
                loop_done(job, 0)
                if status:
                    job.run.folder.mkdir(parents=True)
                    (job.run.folder / "ended.json").write_text(json.dumps({"status": status}))
                    list_files(job.run.folder, ["ended.json"])
                run_ended(job, "")
            return list(failures)

        def report(folder, console):
            reported.append(folder)
            return too_few

        def report_of_all(folders, path, console):
            reported.append((folders, path))
            return too_few

        monkeypatch.setattr(module, "go_through_all", go_through_all)
        monkeypatch.setattr(module, "write_results", report)
        monkeypatch.setattr(module, "write_all_results", report_of_all)
        return reported

    return pretended


def test_it_opens_with_where_the_report_will_be_and_what_will_be_done(command, pretend):
    reported = pretend()
    status, output, errors = command(*COMMAND, "--workers", "7")
    assert (status, errors) == (0, "")
    assert output.splitlines()[:3] == [
        "The report will be at out/report.html",
        "2 runs: TD/MD, each with seeds 0–1",
        "3 loops a run, 2 at a time; Ctrl-C stops, the same command goes on",
    ]
    assert [str(path) for path in reported] == ["out"]


def test_what_is_done_is_not_done_again_and_more_seeds_may_be_added(command, pretend):
    pretend()
    command(*COMMAND)
    status, output, _ = command(*COMMAND, "--seeds", "3")
    assert status == 0
    assert "2 of them are done, 0 go on from a checkpoint" in output
    assert "3 loops a run, 1 at a time" in output
    _, output, _ = command(*COMMAND, "--seeds", "3")
    assert "3 of them are done" in output
    assert "at a time" not in output


def test_other_settings_need_another_folder(command, pretend):
    pretend()
    command(*COMMAND)
    status, output, errors = command(*COMMAND, "training.epochs=6")
    assert (status, output) == (2, "")
    assert "training.epochs: 5 → 6" in errors


@pytest.mark.parametrize(
    ("more", "folder"),
    [([], "runs/default"), (["--quick"], "runs/default-quick"), (["--preset", "paper"], None)],
)
def test_without_a_name_the_folder_is_that_of_the_preset(command, pretend, here, more, folder):
    pretend()
    _, output, _ = command("reproduce", *more, "--set", *SMALL)
    folder = folder or "runs/paper"
    assert output.startswith(f"The report will be at {folder}/report.html\n12 runs: ")
    assert (here / folder / "TND-MND" / "seed-2").is_dir()


def test_diverged_runs_are_told_and_no_error(command, pretend):
    pretend(status="diverged")
    status, output, errors = command(*COMMAND)
    assert (status, errors) == (0, "")
    assert "2 of 2 runs diverged: TD/MD seed 0, TD/MD seed 1; see the report" in output


def test_runs_that_cannot_go_on_are_an_error_after_the_report(command, pretend):
    reported = pretend(failures=["TD/MD seed 1: cut short"])
    status, _, errors = command(*COMMAND)
    assert (status, errors) == (2, "motionese: TD/MD seed 1: cut short\n")
    assert reported


def test_without_any_run_there_is_no_report(command, pretend):
    reported = pretend(status="", failures=["TD/MD seed 0: full", "TD/MD seed 1: full"])
    status, _, errors = command(*COMMAND)
    assert (status, errors) == (2, "motionese: TD/MD seed 0: full; TD/MD seed 1: full\n")
    assert not reported


@pytest.mark.parametrize(("more", "expected"), [([], 2), (["--quick"], 0)])
def test_too_few_seeds_are_an_error_but_in_a_trial(command, pretend, more, expected):
    reported = pretend(too_few="1 seed is too few for a test")
    status, _, errors = command(*COMMAND, *more)
    assert (status, errors) == (expected, "motionese: 1 seed is too few for a test\n")
    assert reported


def test_other_versions_are_told(command, pretend, here):
    pretend()
    command(*COMMAND)
    file = here / "out" / "environment.json"
    file.write_text(json.dumps({**json.loads(file.read_text()), "jax": "0.0.1"}))
    list_files(file.parent, [file.name])
    _, output, _ = command(*COMMAND)
    assert "This folder was begun with other versions (jax: 0.0.1 → " in output


SEVERAL = [*COMMAND, "--preset", "default", "order"]


def test_several_presets_have_a_folder_each_and_one_report(command, pretend, here):
    reported = pretend()
    status, output, errors = command(*SEVERAL)
    assert (status, errors) == (0, "")
    assert output.splitlines()[:4] == [
        "The report will be at out/report.html",
        "2 runs of default: TD/MD, each with seeds 0–1",
        "2 runs of order: TD/MD, each with seeds 0–1",
        "3 loops a run, 2 at a time; Ctrl-C stops, the same command goes on",
    ]
    assert "order TD/MD seed 1 ended; 0 runs to go, 12 of 12 loops" in output
    assert reported == [([Path("out/default"), Path("out/order")], Path("out/report.html"))]
    for name in ("default", "order"):
        assert json.loads((here / "out" / name / "settings.json").read_text())["preset"] == name
        assert (here / "out" / name / "TD-MD" / "seed-1" / "ended.json").is_file()


def test_of_several_presets_only_what_is_left_is_done(command, pretend):
    pretend()
    command(*COMMAND, "--out", "out/order", "--preset", "order")
    status, output, _ = command(*SEVERAL)
    assert status == 0
    assert "2 of them are done, 0 go on from a checkpoint" in output
    assert command(*SEVERAL)[1].splitlines()[-1] == "4 of them are done, 0 go on from a checkpoint"


def test_without_a_name_the_folder_is_that_of_all_presets(command, pretend):
    pretend()
    _, output, _ = command("reproduce", "--quick", "--preset", "order", "free", "--set", *SMALL)
    assert output.startswith("The report will be at runs/order-free-quick/report.html\n12 runs of ")


def test_presets_of_different_lengths_are_told_together(command, pretend, here):
    pretend()
    (here / "long.toml").write_text(preset_text("three_stages"))
    mixed = ("--quick", "--seeds", "1", "--out", "out", "--preset", "default", "long.toml")
    _, output, _ = command("reproduce", *mixed)
    assert "4 to 6 loops a run, " in output
    assert "runs of long: " in output


WRONG_OF_SEVERAL = {
    "twice": (["--preset", "order", "order"], "several are called order"),
    "one stem": (["--preset", "order", "mine/order.toml"], "several are called order"),
    "setting": (["--set", "stages.2.until.loops=1"], "preset order: unknown setting 'stages.2'"),
    "condition": (
        ["--preset", "order", "paces.toml", "--conditions", "TD/MD"],
        "preset paces: unknown condition 'TD/MD'",
    ),
    "caregiver": (["--caregiver", "me"], "preset three_stages: --caregiver is scripted or"),
    "a run folder": (["--out", "one"], "one is a run folder itself"),
    "other settings": (["--out", "other"], "other/order holds runs of other settings"),
    "foreign": (["--out", "foreign"], "foreign is not empty and no run folder lies in it"),
    "a file": (["--out", "foreign/thesis.txt"], "foreign/thesis.txt is a file"),
}


PACES = """
factors = {pace = ["slow", "fast"]}
[[stages]]
lesson = "primitives"
levels = ["io", "cf"]
until = {loops = 1}
"""


@pytest.mark.parametrize(("more", "told"), WRONG_OF_SEVERAL.values(), ids=WRONG_OF_SEVERAL.keys())
def test_what_is_wrong_for_one_of_several_is_told_before_anything_is_written(
    command, pretend, here, more, told
):
    reported = pretend()
    for folder in (here / "one", here / "other" / "order", here / "foreign"):
        folder.mkdir(parents=True)
    write_settings(here / "one")
    write_settings(here / "other" / "order")
    (here / "foreign" / "thesis.txt").write_text("three years of work")
    (here / "paces.toml").write_text(PACES)
    before = sorted(here.rglob("*"))
    presets = [] if "--preset" in more else ["--preset", "three_stages", "order"]
    status, output, errors = command("reproduce", "--quick", "--seeds", "1", *presets, *more)
    assert (status, output) == (2, "")
    assert errors.startswith("motionese: ") and told in errors and errors.count("\n") == 1
    assert sorted(here.rglob("*")) == before and not reported


def test_one_of_several_that_is_in_use_is_told(command, pretend, here):
    pretend()
    with open_run_folder(here / "out" / "order", read_settings("order"), "order"):
        _, _, errors = command("reproduce", "--preset", "default", "order", "--out", "out")
    assert "out/order is in use by another process" in errors
    assert not (here / "out" / "default" / "settings.json").exists()


def test_a_preset_of_which_no_run_has_ended_is_left_out_of_the_report(command, pretend):
    pretend()
    command(*COMMAND, "--out", "out/default")
    reported = pretend(status="", failures=["order TD/MD seed 0: full"])
    status, _, errors = command(*SEVERAL)
    assert (status, errors) == (2, "motionese: order TD/MD seed 0: full\n")
    assert reported == [([Path("out/default")], Path("out/report.html"))]
