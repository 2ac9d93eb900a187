"""The environment of one run's process: one thread, compiled functions kept where they can be."""

import os
import subprocess
import sys

import pytest

from motionese.one_core import cache_folder, one_core, one_core_each

VARIABLES = ("XLA_FLAGS", "JAX_PLATFORMS", "JAX_COMPILATION_CACHE_DIR", "OMP_NUM_THREADS")


@pytest.fixture(autouse=True)
def bare(monkeypatch, tmp_path):
    for name in VARIABLES:
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def test_one_thread_on_the_cpu():
    variables = one_core()
    assert variables["XLA_FLAGS"] == "--xla_cpu_multi_thread_eigen=false"
    assert variables["JAX_PLATFORMS"] == "cpu"
    assert variables["OMP_NUM_THREADS"] == variables["OPENBLAS_NUM_THREADS"] == "1"


def test_what_the_user_has_set_stands(monkeypatch):
    monkeypatch.setenv("XLA_FLAGS", "--xla_dump_to=somewhere")
    monkeypatch.setenv("JAX_COMPILATION_CACHE_DIR", "mine")
    variables = one_core()
    assert variables["XLA_FLAGS"] == "--xla_dump_to=somewhere --xla_cpu_multi_thread_eigen=false"
    assert variables["JAX_COMPILATION_CACHE_DIR"] == "mine"
    monkeypatch.setenv("XLA_FLAGS", "--xla_cpu_multi_thread_eigen=true")
    assert one_core()["XLA_FLAGS"] == "--xla_cpu_multi_thread_eigen=true"


def test_processes_started_meanwhile_have_it_and_this_one_has_it_not():
    before = dict(os.environ)
    with one_core_each():
        command = [sys.executable, "-c", "import os; print(os.environ['XLA_FLAGS'])"]
        started = subprocess.run(command, capture_output=True, text=True, check=True)
        os.environ["LEFT_BEHIND"] = "1"
    assert started.stdout == "--xla_cpu_multi_thread_eigen=false\n"
    assert dict(os.environ) == before


def test_compiled_functions_are_kept_in_the_users_cache(tmp_path):
    folder = cache_folder()
    assert folder.parent == tmp_path / "cache" / "motionese"
    assert one_core()["JAX_COMPILATION_CACHE_DIR"] == str(folder)
    assert folder.is_dir()


@pytest.mark.skipif(sys.platform != "linux", reason="other platforms have other folders")
def test_without_a_named_cache_it_is_the_home_folders(monkeypatch, tmp_path):
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.setenv("HOME", str(tmp_path))
    assert cache_folder().parent == tmp_path / ".cache" / "motionese"


def test_where_nothing_can_be_written_nothing_is_kept(monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert "JAX_COMPILATION_CACHE_DIR" not in one_core()
