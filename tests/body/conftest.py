import numpy as np
import pytest

from motionese.body import load_model
from motionese.body.actroid import Actroid, ActroidSettings
from motionese.body.rendering import open_renderer
from motionese.errors import RenderingError
from motionese.minimum_jerk import minimum_jerk as minimum_jerk_of
from motionese.task import PUSHING_BUTTONS

STROKES = [("UR", "LR"), ("LR", "UR"), ("UR", "UL"), ("UL", "LL"), ("LL", "UL")]


@pytest.fixture(scope="session")
def body():
    """The body of the standard experiment; every trial restores it."""
    return Actroid(ActroidSettings(), PUSHING_BUTTONS)


@pytest.fixture(scope="session")
def exact_body():
    """A body whose projected view has no noise."""
    return Actroid(ActroidSettings(pixel_noise=0.0), PUSHING_BUTTONS)


@pytest.fixture(scope="session")
def gl():
    """Skips where no pictures can be rendered, with the reason."""
    try:
        open_renderer(load_model(ActroidSettings(), PUSHING_BUTTONS), 64, 48).close()
    except RenderingError as refusal:
        pytest.skip(str(refusal))


@pytest.fixture
def rng():
    return np.random.default_rng(11)


@pytest.fixture
def minimum_jerk():
    """Twelve steps of a stroke and two of rest, as shares of the way."""
    return minimum_jerk_of(np.minimum(np.arange(1, 15) / 12, 1.0))


@pytest.fixture(params=STROKES, ids=lambda s: f"{s[0]}-{s[1]}")
def stroke(request):
    return request.param
