"""Run folders: made, gone on with, refused; free after a kill; told by one clear sentence."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from motionese.errors import RunFolderError
from motionese.experiment import condition_named, read_settings, run_folder
from motionese.experiment.run_folder import open_run_folder, run_settings

HOLDING = """
import sys, time
from pathlib import Path
from motionese.experiment import read_settings
from motionese.experiment.run_folder import open_run_folder
with open_run_folder(Path(sys.argv[1]), read_settings(), "default"):
    print("open", flush=True)
    time.sleep(60)
"""


@pytest.fixture(scope="module")
def settings():
    return read_settings()


LISTED = ("settings.json", "environment.json")


def opened(path, settings):
    with open_run_folder(path, settings, "default") as folder:
        return folder


def refused(path, settings):
    with pytest.raises(RunFolderError) as caught, open_run_folder(path, settings, "default"):
        pass
    sentence = str(caught.value)
    assert str(path) in sentence
    assert "\n" not in sentence
    return sentence


def test_a_new_folder_tells_settings_and_environment(tmp_path, settings):
    path = tmp_path / "runs" / "first"
    opened(path, settings)
    facts = json.loads((path / "settings.json").read_text())
    assert (facts["format"], facts["version"], facts["preset"]) == ("motionese-run", 5, "default")
    assert facts["settings"] == settings.model_dump(mode="json") == run_settings(path)
    made_with = json.loads((path / "environment.json").read_text())
    assert made_with["python"] == sys.version.split()[0]
    assert {"jax", "numpy", "mujoco-core", "motionese", "machine", "cores"} <= made_with.keys()
    assert {p.name for p in path.iterdir()} <= {*LISTED, "SHA256SUMS", ".lock"}


def test_a_run_has_a_folder_of_its_own(tmp_path, settings):
    run = opened(tmp_path, settings).run(condition_named("TND/MD", settings.factors), 7)
    assert run.folder == tmp_path / "TND-MD" / "seed-7"
    assert run.name == "TND/MD seed 7"


def test_an_empty_folder_is_taken(tmp_path, settings):
    opened(tmp_path, settings)
    assert (tmp_path / "settings.json").is_file()


def test_the_same_settings_go_on_and_leave_the_files_as_they_are(tmp_path, settings):
    opened(tmp_path, settings)
    before = {p.name: p.read_bytes() for p in tmp_path.glob("*.json")}
    assert opened(tmp_path, settings).changed == ()
    assert {p.name: p.read_bytes() for p in tmp_path.glob("*.json")} == before


def test_other_settings_are_refused_with_every_difference(tmp_path, settings):
    opened(tmp_path, settings)
    other = read_settings(overrides=["network.levels.cs.tau=40", "training.epochs=7"])
    sentence = refused(tmp_path, other)
    assert "network.levels.cs.tau: 70.0 → 40.0" in sentence
    assert "training.epochs: 600 → 7" in sentence
    assert "choose another --out" in sentence


def test_a_folder_that_is_not_ours_is_left_alone(tmp_path, settings):
    (tmp_path / "thesis.txt").write_text("three years of work")
    assert "not empty" in refused(tmp_path, settings)
    assert [p.name for p in tmp_path.iterdir()] == ["thesis.txt"]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{}", "not written by motionese"),
        ("[]", "not written by motionese"),
        ('{"format": "motionese-run"', "cannot be read"),
        ('{"format": "motionese-run", "version": 1, "settings": {}}', "format 1"),
        ('{"format": "motionese-run", "version": 5}', "holds no settings"),
        ('{"format": "motionese-run", "version": 5, "settings": 5}', "holds no settings"),
    ],
)
def test_settings_that_are_not_ours_are_refused(tmp_path, settings, content, told):
    (tmp_path / "settings.json").write_text(content)
    assert told in refused(tmp_path, settings)
    with pytest.raises(RunFolderError, match=told):
        run_settings(tmp_path)


def test_a_file_is_refused(tmp_path, settings):
    path = tmp_path / "report.pdf"
    path.touch()
    assert "is a file" in refused(path, settings)


def test_a_folder_below_a_file_is_refused(tmp_path, settings):
    (tmp_path / "file").touch()
    assert "cannot be written to: Not a directory" in refused(tmp_path / "file" / "run", settings)


def test_a_read_only_folder_is_refused(tmp_path, settings, monkeypatch):
    tmp_path.chmod(0o555)
    if os.access(tmp_path, os.W_OK):  # Permission bits do not bind this user: play the refusal.

        def mkdir(path, *_, **__):
            raise PermissionError(13, "Permission denied", str(path))

        monkeypatch.setattr(Path, "mkdir", mkdir)
    assert "cannot be written to: Permission denied" in refused(tmp_path / "run", settings)
    tmp_path.chmod(0o755)


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can become another user")
def test_what_an_ordinary_user_may_not_write_to_is_refused_and_left_alone(tmp_path, settings):
    folder = tmp_path / "run"
    opened(folder, settings)
    for path in (tmp_path, *tmp_path.parents[:-2]):
        path.chmod(0o755)
    before = {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    os.seteuid(65534)
    try:
        assert f"{folder} cannot be written to: Permission denied" in refused(folder, settings)
        new = tmp_path / "new"
        assert f"{new} cannot be written to: Permission denied" in refused(new, settings)
    finally:
        os.seteuid(0)
    assert {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()} == before


def test_a_full_or_read_only_file_system_is_refused(tmp_path, settings, monkeypatch):
    def write_whole(path, content):
        raise OSError(30, "Read-only file system", str(path))

    monkeypatch.setattr(run_folder, "write_whole", write_whole)
    assert "cannot be written to: Read-only file system" in refused(tmp_path / "run", settings)


def test_a_folder_in_use_is_refused_and_free_after_a_kill(tmp_path, settings):
    command = [sys.executable, "-c", HOLDING, str(tmp_path)]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as other:
        try:
            assert other.stdout.readline() == "open\n"
            sentence = refused(tmp_path, settings)
            assert f"in use by another process (number {other.pid})" in sentence
        finally:
            other.kill()
    assert opened(tmp_path, settings).path == tmp_path


def test_what_a_killed_process_left_half_written_is_removed(tmp_path, settings):
    opened(tmp_path, settings)
    half = tmp_path / "TD-MD" / "seed-0" / ".loop-01.safetensors.99.part"
    half.parent.mkdir(parents=True)
    half.write_bytes(b"half")
    opened(tmp_path, settings)
    assert not half.exists()


def test_a_process_killed_before_it_wrote_settings_leaves_a_usable_folder(tmp_path, settings):
    for name in (".lock", ".lock-holder", ".settings.json.99.part"):
        (tmp_path / name).touch()
    opened(tmp_path, settings)
    assert run_settings(tmp_path)


def test_other_versions_are_told_and_kept_on_record(tmp_path, settings, monkeypatch):
    opened(tmp_path, settings)
    first = json.loads((tmp_path / "environment.json").read_text())
    monkeypatch.setattr(run_folder, "environment", lambda: {**first, "jax": "99.0"})
    for _ in range(2):
        assert opened(tmp_path, settings).changed == (f"jax: {first['jax']} → 99.0",)
    now = json.loads((tmp_path / "environment.json").read_text())
    assert now == {**first, "changed": [f"jax: {first['jax']} → 99.0"]}


@pytest.mark.parametrize("name", [*LISTED, "SHA256SUMS"])
def test_a_byte_that_changed_is_told_and_put_right_by_what_is_said(tmp_path, settings, name):
    opened(tmp_path, settings)
    path = tmp_path / name
    whole = path.read_bytes()
    path.write_bytes(whole[:20] + bytes([whole[20] ^ 1]) + whole[21:])
    sentence = refused(tmp_path, settings)
    again = "remove it, and the same `motionese reproduce` command writes it again"
    assert sentence == f"{path} has changed since it was written: {again}"
    path.unlink()
    opened(tmp_path, settings)
    assert path.read_bytes() == whole


def test_no_folder_and_no_run_folder_are_told_apart(tmp_path):
    with pytest.raises(RunFolderError, match="there is no such folder"):
        run_settings(tmp_path / "missing")
    with pytest.raises(RunFolderError, match=r"has no settings\.json"):
        run_settings(tmp_path)
