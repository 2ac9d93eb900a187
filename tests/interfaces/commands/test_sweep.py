"""What `motionese sweep` says and leaves, alone and in shards."""

import json

import pandas as pd
import pytest
from small_runs import SMALL, left_on_disk

from motionese.experiment.digests import list_files
from motionese.interfaces.commands import reproduce, sweep

SETTINGS = ["--quick", "--conditions", "TD/MD", "--seeds", "2", "--set", *SMALL]
VARY = ["--vary", "network.levels.cs.tau=35,70"]
LABELS = ["cs.tau=35", "cs.tau=70"]


@pytest.fixture
def pretend(monkeypatch):
    """Let every run end at once; return what is reported, and which runs were done."""
    reported, done = [], []

    def go_through_all(jobs, workers, *, loop_done, run_ended):
        for job in jobs:
            job.run.folder.mkdir(parents=True)
            (job.run.folder / "ended.json").write_text(json.dumps({"status": "finished"}))
            list_files(job.run.folder, ["ended.json"])
            done.append(job.name)
        return []

    def report_of_all(folders, path, console):
        reported.append(([folder.name for folder in folders], str(path)))
        return ""

    monkeypatch.setattr(reproduce, "go_through_all", go_through_all)
    monkeypatch.setattr(sweep, "write_all_results", report_of_all)
    return reported, done


def test_without_a_name_it_lists_what_there_is(command):
    status, output, errors = command("sweep")
    assert (status, errors) == (0, "")
    assert "slow_tau: Time constant of the slow level: how slow must it be?" in output


def test_every_point_has_a_run_folder_and_all_have_one_report(command, pretend):
    reported, done = pretend
    status, output, errors = command("sweep", *VARY, *SETTINGS)
    assert (status, errors) == (0, "")
    assert output.startswith("The report will be at runs/sweep-tau-quick/report.html\n")
    assert reported == [(LABELS, "runs/sweep-tau-quick/report.html")]
    assert sorted(done) == [f"{label} TD/MD seed {n}" for label in LABELS for n in (0, 1)]


def test_what_the_command_line_says_stands_in_the_place_of_the_file(command, pretend, here):
    _, done = pretend
    (here / "mine.toml").write_text(
        'preset = "free"\nconditions = ["TND/MD"]\n[vary]\n"network.levels.cs.tau" = [35, 70]\n'
    )
    quick = ["--quick", "--seeds", "1", "--out"]
    assert command("sweep", "mine.toml", *quick, "a")[0] == 0
    assert command("sweep", "mine.toml", "--conditions", "TD/MD", *quick, "b")[0] == 0
    assert [name.split()[1] for name in done] == ["TND/MD", "TND/MD", "TD/MD", "TD/MD"]
    settings = json.loads((here / "a" / LABELS[0] / "settings.json").read_text())
    assert settings["preset"] == "free"


def test_a_shard_does_its_part_and_leaves_the_report(command, pretend):
    reported, done = pretend
    for part in ("1/2", "2/2"):
        status, output, errors = command("sweep", *VARY, *SETTINGS, "--shard", part, "--out", "o")
        assert (status, errors) == (0, "")
        assert f"Shard {part}: 2 of 4 runs" in output
        assert "When all shards have ended, `motionese report o` writes the report" in output
    assert len(set(done)) == len(done) == 4
    assert reported == []


WRONG = {
    "no setting": (["--vary", "network.levels.cx.tau=1,2"], "unknown setting 'network.levels.cx'"),
    "no number": (["--vary", "training.attention.to=rests,movement"], "a sweep is over numbers"),
    "one point": (["--vary", "training.epochs=5"], "a sweep has 2 to 200 points, got 1"),
    "a point": (
        ["--vary", "network.levels.cs.tau=0.5,70"],
        "point of the sweep cs.tau=0.5: setting network.levels.cs.tau = 0.5: input should be",
    ),
    "no sweep": (["slowtau"], "unknown sweep 'slowtau'; did you mean 'slow_tau'?"),
    "both": (["slow_tau", *VARY], "name one sweep (`motionese sweep` alone lists those"),
    "condition": (["slow_tau", "--conditions", "XX"], "unknown condition 'XX'"),
    "shard": ([*VARY, "--shard", "3/2"], "--shard 3/2: write I/N, the I-th of N parts"),
    "two places": (
        [*VARY, "--workers", "2", "--scheduler", "tcp://here:1"],
        "--workers and --scheduler exclude each other",
    ),
    "nobody there": (
        [*VARY, "--scheduler", "tcp://127.0.0.1"],
        "--scheduler tcp://127.0.0.1: no Dask scheduler answers there (missing port number",
    ),
    "slurm": ([*VARY, "--slurm", "none.toml"], "none.toml: cannot be read"),
}


@pytest.mark.parametrize(("more", "told"), WRONG.values(), ids=WRONG.keys())
def test_what_is_wrong_is_told_before_anything_is_written(command, pretend, here, more, told):
    status, _, errors = command("sweep", *more, "--out", "out")
    assert status == 2
    assert told in errors
    assert errors.count("\n") == 1
    assert not (here / "out").exists()


@pytest.mark.slow
def test_shards_leave_the_same_as_one_command_and_the_page_tells_it(command, here):
    assert command("sweep", *VARY, *SETTINGS, "--out", "whole")[0] == 0
    for part in ("1/2", "2/2"):
        assert command("sweep", *VARY, *SETTINGS, "--shard", part, "--out", "parts")[0] == 0
    command("report", "parts")
    for label in LABELS:
        for run in sorted((here / "whole" / label).glob("*/seed-*")):
            same = here / "parts" / run.relative_to(here / "whole")
            assert left_on_disk(same) == left_on_disk(run)
    for table in ("sweep_findings.csv", "sweep_effects.csv"):
        assert (here / "parts" / table).read_bytes() == (here / "whole" / table).read_bytes()
    effects = pd.read_csv(here / "whole" / "sweep_effects.csv")
    assert set(effects["point"]) == set(LABELS)
    page = (here / "whole" / "report.html").read_text()
    assert "Reference: <strong>cs.tau=70</strong>" in page
