"""A robot that has learned next to nothing, quickly made, and a session with it."""

import pytest
from drawn import VIEW, points_of
from small_runs import compiled, small_settings

from motionese.experiment import Scene
from motionese.teaching.beginning import begun_with
from motionese.teaching.drawing import Drawing, demonstrated
from motionese.teaching.notebook import Notebook
from motionese.teaching.session import Teaching

__all__ = ["compiled", "small_settings"]


@pytest.fixture(scope="session")
def scene(small_settings, compiled):
    return Scene(small_settings, seed=0)


@pytest.fixture(scope="session")
def fresh(scene):
    return begun_with("fresh", scene)


@pytest.fixture
def teaching(scene, fresh):
    return Teaching(scene, fresh, Notebook())


@pytest.fixture
def draw(scene):
    """Draw a motion; returns the demonstration."""

    def drawn(name: str, **how):
        drawing = Drawing()
        drawing.add(points_of(name, **how))
        positions, _ = VIEW.positions(drawing.sampled(scene.body.rate_hz))
        return demonstrated(positions, scene.settings.caregiver)

    return drawn
