"""The house: which room may import which, what files may be called, and what rooms promise."""

import importlib
import tomllib
from pathlib import Path

import pytest
from importlinter.cli import lint_imports

import motionese

ROOT = Path(__file__).parents[1]
SOURCES = sorted((ROOT / "src" / "motionese").rglob("*.py"))
ROOMS = (
    *("recordings", "runtime", "network", "body", "caregiver"),
    *("learning", "experiment", "analysis", "interfaces"),
)
PUBLIC = ["motionese", *(f"motionese.{room}" for room in ROOMS if room != "interfaces")]


def test_a_room_imports_only_lower_rooms(monkeypatch):
    monkeypatch.chdir(ROOT)

    assert lint_imports(config_filename="pyproject.toml", cache_dir=None) == 0


def test_the_contract_names_every_room_and_every_single_file():
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    (contract,) = settings["tool"]["importlinter"]["contracts"]
    named = {name for layer in contract["layers"] for name in layer.split(" | ")}

    folders = {path.parent for path in SOURCES if path.parent.parent.name == "motionese"}
    files = {path.with_suffix("") for path in SOURCES if path.parent.name == "motionese"}
    present = {path.name for path in folders | files} - {"__init__"}
    assert named == {f"motionese.{name}" for name in present}


def test_no_file_is_a_drawer_for_everything():
    drawers = {"utils", "util", "common", "helpers", "helper", "misc"}
    assert SOURCES
    assert not [path for path in SOURCES if path.stem in drawers or path.parent.name in drawers]


@pytest.mark.parametrize("package", PUBLIC)
def test_every_public_name_exists_once_and_is_explained(package):
    room = importlib.import_module(package)

    assert room.__doc__
    assert len(set(room.__all__)) == len(room.__all__)
    for name in room.__all__:
        value = getattr(room, name)
        if callable(value) and getattr(value, "__module__", "").startswith("motionese"):
            assert value.__doc__, name


def test_the_package_s_own_public_names_are_those_of_its_design():
    fixed = {"MTRNN", "Level", "Motions", "train", "recognise", "generate", "grow", "save", "load"}

    assert fixed <= set(motionese.__all__)
