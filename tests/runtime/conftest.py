"""A small model as a file, and as the runtime reads it."""

import pytest
from small_models import written

from motionese.runtime import load


@pytest.fixture(scope="session")
def saved(request, tmp_path_factory):
    """The file, the network and the initial states; its `initial_io` may be parametrised."""
    path = tmp_path_factory.mktemp("model") / "robot.safetensors"
    initial_io = getattr(request, "param", "sensed")
    facts = {"rate_hz": 20.0, "lengths": [41, 31]}
    return path, *written(path, initial_io=initial_io, facts=facts)


@pytest.fixture(scope="session")
def model(saved):
    return load(saved[0])
