"""A robot that serves no page: what it is told, and what it tells."""

import time

import pytest
from drawn import strokes

from motionese.imitation import Scene, newborn
from motionese.interfaces.page.robot import Robot
from motionese.teaching.session_folder import SessionFolder


@pytest.fixture
def draw_with():
    """Draw a motion for a robot in this process."""

    def drawn(robot, name):
        for message in strokes(name):
            points = [tuple(point) for point in message["points"]]
            more = {"source": "drawn", "follow": False, "received": time.monotonic()}
            robot.take({**message, "points": points, **more})

    return drawn


@pytest.fixture
def told():
    """All that the robot tells."""
    return []


@pytest.fixture
def robot(tmp_path, small_settings, told):
    """A robot of three levels that has learned nothing."""
    folder, scene = SessionFolder(tmp_path / "session"), Scene(small_settings, 0)
    teaching = folder.begin("fresh", scene, newborn(scene, 3))
    robot = Robot(folder, teaching, told.append, stop_asked=lambda: False)
    robot.introduce()
    return robot


@pytest.fixture
def does(robot):
    """Let the robot do something to its end."""

    def done(kind, **more):
        robot.take({"type": kind, **more})
        while robot.going is not None:
            robot.go_on()

    return done
