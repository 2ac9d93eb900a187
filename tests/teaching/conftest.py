"""A robot that has learned next to nothing, quickly made, and a session with it."""

import pytest
from drawn import points_of, view
from small_runs import small_settings

from motionese.imitation import Scene, newborn
from motionese.teaching import session
from motionese.teaching.drawing import Drawing, at_tempo
from motionese.teaching.session import PRACTICE, Teaching

__all__ = ["small_settings"]


@pytest.fixture(scope="session")
def scene(small_settings):
    return Scene(small_settings, seed=0)


@pytest.fixture(scope="session")
def fresh(scene):
    return newborn(scene, 2)


@pytest.fixture
def teaching(scene, fresh):
    return Teaching(scene, fresh)


@pytest.fixture
def kept(monkeypatch):
    """Every lesson is kept, however little its short training brings."""

    def last(errors_cm, overall_cm, missed):
        overall_cm(0), overall_cm(PRACTICE)
        return PRACTICE

    monkeypatch.setattr(session, "kept_practice", last)


@pytest.fixture(scope="session")
def draw_in_time(scene):
    """Draw a sequence; returns the hand's path as it went in time."""

    def drawn(name: str, **how):
        drawing = Drawing()
        drawing.add(points_of(name, **how))
        return view().positions(drawing.sampled(scene.body.rate_hz))[0]

    return drawn


@pytest.fixture
def draw(scene, draw_in_time):
    """Draw a sequence; returns the hand's path at the robot's tempo."""

    def drawn(name: str, **how):
        return at_tempo(draw_in_time(name, **how), scene.task, scene.settings.caregiver)

    return drawn
