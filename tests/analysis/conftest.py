import json

import pytest
from invented_runs import CONDITIONS, list_anew, write_run, write_settings

from motionese.errors import RenderingError
from motionese.experiment import read_settings


@pytest.fixture
def make_run():
    return write_run


@pytest.fixture(scope="session")
def eight_seeds(tmp_path_factory):
    """Four conditions of eight seeds each, in which the paper's claims hold."""
    root = tmp_path_factory.mktemp("eight")
    for condition in CONDITIONS:
        for seed in range(8):
            write_run(root, condition, seed)
    write_settings(root, read_settings(overrides=["network.gain=3.25"]), preset="<mine>")
    (root / "environment.json").write_text(json.dumps({"python": "3.11", "jax": "0.9"}))
    list_anew(root)
    return root


@pytest.fixture(scope="session")
def orderly(tmp_path_factory):
    """Four conditions of three seeds whose lesson asks for order, the roles separated in TD/MD."""
    root, study = tmp_path_factory.mktemp("orderly"), read_settings("order")
    for condition in study.conditions:
        for seed in range(3):
            write_run(root, condition, seed, study=study)
    return root


@pytest.fixture
def unrendered(monkeypatch):
    """A machine without GL."""

    def refuse(model, poses, **_):
        raise RenderingError("pictures cannot be rendered on this machine: no GL")

    monkeypatch.setattr("motionese.analysis.film.pictures", refuse)
