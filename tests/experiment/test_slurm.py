"""Workers in jobs of Slurm: what is asked for, and what is refused."""

import subprocess
from pathlib import Path

import pytest

from motionese.errors import SettingError
from motionese.experiment import slurm
from motionese.experiment.slurm import Slurm, open_cluster, read_slurm, workers_of_slurm

ASKED = """
jobs = 3
workers = 4
memory = "8GB"
walltime = "04:00:00"
queue = "cpu"
account = "lab"
directives = ["--constraint=avx512"]
prologue = ["module load gcc"]
"""


@pytest.fixture
def asked(tmp_path):
    file = tmp_path / "slurm.toml"
    file.write_text(ASKED)
    return read_slurm(file)


def test_a_job_is_asked_for_as_the_settings_say(asked):
    with open_cluster(asked) as cluster:
        lines = cluster.job_script().splitlines()
    for line in ("-p cpu", "-A lab", "--cpus-per-task=4", "-t 04:00:00", "--constraint=avx512"):
        assert f"#SBATCH {line}" in lines
    assert "module load gcc" in lines
    assert "--nthreads 1" in lines[-1]
    assert "--nworkers 4" in lines[-1]


@pytest.mark.parametrize(
    ("was", "wrong", "told"),
    [
        ("jobs = 3", "jobs = 0", "setting jobs = 0: input should be greater than or equal to 1"),
        ("jobs = 3", "", "setting jobs is missing"),
        ("queue", "partition", "unknown setting 'partition'"),
        ('"8GB"', '"much"', "setting memory = 'much': "),
        ('"04:00:00"', '"soon"', "setting walltime = 'soon': "),
        ("jobs = 3", "jobs", "not a TOML file"),
    ],
)
def test_a_wrong_setting_is_named(tmp_path, was, wrong, told):
    file = tmp_path / "slurm.toml"
    file.write_text(ASKED.replace(was, wrong))
    with pytest.raises(SettingError, match=f"{file}: {told}"):
        read_slurm(file)


def refused(asked):
    with pytest.raises(SettingError) as error, workers_of_slurm(asked, [], print):
        pass
    return str(error.value)


def test_where_there_is_no_sbatch_it_says_so(asked, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    assert "there is no `sbatch` here" in refused(asked)


def test_what_sbatch_refuses_is_told_in_its_words(asked, monkeypatch):
    def run(command, **_):
        assert command[:2] == ["sbatch", "--test-only"]
        assert "#SBATCH -p cpu" in Path(command[2]).read_text()
        raise subprocess.CalledProcessError(1, command, stderr="invalid partition")

    monkeypatch.setattr(slurm.subprocess, "run", run)
    assert "`sbatch` refuses the jobs: invalid partition" in refused(asked)


def test_an_interface_that_does_not_exist_is_named(asked: Slurm):
    with pytest.raises(SettingError, match="nowhere0"):
        open_cluster(asked.model_copy(update={"interface": "nowhere0"}))
