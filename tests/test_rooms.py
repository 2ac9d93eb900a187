"""The house: which room may import which, what files may be called, and what rooms promise."""

import ast
import importlib
import tomllib
from pathlib import Path

import pytest
from importlinter.cli import lint_imports

import motionese

ROOT = Path(__file__).parents[1]
SOURCES = sorted((ROOT / "src" / "motionese").rglob("*.py"))
ROOMS = sorted({path.parent.name for path in (ROOT / "src" / "motionese").glob("*/__init__.py")})
BY_MODULE = {"interfaces", "teaching"}
"""Rooms whose modules are asked by name; every other has public names of its own."""
PUBLIC = ["motionese", *(f"motionese.{room}" for room in ROOMS if room not in BY_MODULE)]


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
def test_every_public_name_exists_once(package):
    room = importlib.import_module(package)

    assert room.__all__
    assert len(set(room.__all__)) == len(room.__all__)
    assert all(hasattr(room, name) for name in room.__all__)


def test_every_room_class_and_function_is_explained_where_it_is_written():
    # Not asked of `__doc__`: dataclasses and named tuples without one are given their signature.
    unexplained = [
        f"{path.relative_to(ROOT)}: {name}"
        for path in SOURCES
        for name, node in written_in(path)
        if not ast.get_docstring(node)
    ]

    assert not unexplained


def written_in(path):
    """Yield a module, and its public classes and functions, by name."""
    module = ast.parse(path.read_text(encoding="utf-8"))
    yield "", module
    for node in module.body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and not node.name.startswith("_"):
            yield node.name, node


def test_the_package_s_own_public_names_are_those_of_its_design():
    fixed = {"MTRNN", "Level", "Motions", "train", "recognise", "generate", "grow", "save", "load"}

    assert fixed <= set(motionese.__all__)
