"""What the command says and returns when runs diverge, cannot go on, or are too few to test."""

import json

import pytest
from small_runs import SMALL

from motionese.interfaces.commands import reproduce as module

COMMAND = ["reproduce", "--seeds", "2", "--conditions", "TD/MD", "--out", "out", "--set", *SMALL]


@pytest.fixture
def pretend(monkeypatch):
    """Let every run end with a status, or not at all, and the report find too few seeds."""

    def pretended(status="finished", failures=(), too_few=""):
        reported = []

        def go_through_all(runs, settings, workers, *, recordings, loop_done, run_ended):
            assert recordings is None, "scripted ones"
            for run in runs:
                loop_done(run, 0)
                if status:
                    run.folder.mkdir(parents=True)
                    (run.folder / "ended.json").write_text(json.dumps({"status": status}))
                run_ended(run, "")
            return list(failures)

        def report(folder, console):
            reported.append(folder)
            return too_few

        monkeypatch.setattr(module, "go_through_all", go_through_all)
        monkeypatch.setattr(module, "write_results", report)
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
    _, output, _ = command(*COMMAND)
    assert "This folder was begun with other versions (jax: 0.0.1 → " in output
