"""The command line as a user meets it, in this process or in one of its own."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from small_runs import small_settings, undisturbed
from typed import SMALL, typed, write_csv

from motionese.interfaces.commands.command_line import main

__all__ = ["small_settings", "undisturbed"]
COMMAND = str(Path(sys.executable).with_name("motionese"))


@pytest.fixture
def begin(tmp_path):
    """Begin a command in an empty folder and a group of its own; returns the process."""

    def begun(*arguments: str) -> "subprocess.Popen[str]":
        return subprocess.Popen(
            [COMMAND, *arguments],
            cwd=tmp_path,
            env={**os.environ, "COLUMNS": "200"},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )

    return begun


@pytest.fixture
def command(tmp_path, monkeypatch, capfd):
    """Run a command in this process, in an empty folder; returns status, output and errors."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")

    def run(*arguments: str) -> tuple[int, str, str]:
        monkeypatch.setattr(sys, "argv", ["motionese", *arguments])
        with pytest.raises(SystemExit) as left:
            main()
        output, errors = capfd.readouterr()
        return left.value.code, output, errors

    return run


@pytest.fixture
def here(tmp_path) -> Path:
    """The folder that commands run in."""
    return tmp_path


@pytest.fixture(scope="session")
def trained(tmp_path_factory) -> Path:
    """A folder with recordings of an arm, a model of them, and initial states it recognised."""
    folder = tmp_path_factory.mktemp("trained")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        write_csv("demos.csv")
        for line in (
            ("import", "demos.csv", "--out", "data.npz"),
            ("train", "data.npz", "--out", "arm.safetensors", *SMALL, "--held-out", "0"),
            ("recognise", "arm.safetensors", "demos.csv", "--initial", "seen.json"),
            ("export", "data.npz", "--out", "data.hdf5"),
        ):
            status, output, errors = typed(*line)
            assert (status, errors) == (0, ""), errors
            Path(f"{line[0]}.txt").write_text(output)
    return folder


@pytest.fixture
def arm(trained, tmp_path, monkeypatch) -> Path:
    """An empty folder to work in, with the recordings, the model and the initial states."""
    for name in ("demos.csv", "data.npz", "data.hdf5", "arm.safetensors", "seen.json"):
        shutil.copy(trained / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path
