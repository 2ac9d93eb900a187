"""A small model as a file, and as the runtime reads it."""

import pytest
from small_models import written

from motionese.runtime import load


@pytest.fixture(scope="session")
def saved(tmp_path_factory):
    """The file, the network and the initial states."""
    path = tmp_path_factory.mktemp("model") / "robot.safetensors"
    return path, *written(path, facts={"rate_hz": 20.0, "lengths": [41, 31]})


@pytest.fixture(scope="session")
def model(saved):
    return load(saved[0])
