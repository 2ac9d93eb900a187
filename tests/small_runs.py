"""Runs that take a second once everything is compiled, and what they leave on disk."""

import csv
import io
import json
from pathlib import Path

import numpy as np
import pytest
import safetensors

from motionese.experiment import Run, condition_named, go_through, read_settings
from motionese.experiment.digests import DIGESTS, listed

SMALL = (
    "stages.0.until.loops=1",
    "stages.1.until.loops=2",
    "babbling.epochs=5",
    "training.epochs=5",
    "recognition.iterations=5",
    "evaluation.recognition.iterations=5",
    "evaluation.map_points=2",
)
"""Settings laid over those of a quick trial."""


@pytest.fixture(scope="session")
def small_settings():
    return read_settings(overrides=SMALL, quick=True)


@pytest.fixture(scope="session")
def undisturbed(tmp_path_factory, small_settings):
    """All that a run of TD/MD with seed 5 leaves on disk."""
    run = Run(
        condition_named("TD/MD", small_settings.factors), 5, tmp_path_factory.mktemp("undisturbed")
    )
    told = []
    go_through(run, small_settings, told.append)
    assert told == [1, 2, 3]
    return left_on_disk(run.folder)


class StoppedError(Exception):
    """A run was stopped."""


def stopped_after(run, settings, loop):
    """Go through a run until after a loop."""

    def told(done):
        if done == loop:
            raise StoppedError

    with pytest.raises(StoppedError):
        go_through(run, settings, told)


def left_on_disk(folder: Path) -> dict[str, object]:
    """Everything a run wrote, by file, but for the seconds it took and the size of its files."""
    return {
        path.relative_to(folder).as_posix(): _content(path)
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def _content(path: Path) -> object:
    if path.name == DIGESTS:
        return set(listed(path.parent))
    if path.suffix == ".csv":
        return [_timeless(row) for row in csv.DictReader(io.StringIO(path.read_text()))]
    if path.suffix == ".json":
        return _timeless(json.loads(path.read_text()))
    if path.suffix == ".npz":
        with np.load(path) as arrays:
            return {name: (arrays[name].shape, arrays[name].tobytes()) for name in arrays.files}
    with safetensors.safe_open(path, framework="numpy") as file:
        structure = _timeless(json.loads(file.metadata()["motionese"]))
        return structure, {name: file.get_tensor(name).tobytes() for name in file.keys()}  # noqa: SIM118


def _timeless(value: object) -> object:
    if isinstance(value, dict):
        return {name: _timeless(each) for name, each in value.items() if name != "seconds"}
    return [_timeless(each) for each in value] if isinstance(value, list) else value
