"""Drawing for a robot that serves no page."""

import time

import pytest
from drawn import strokes


@pytest.fixture
def draw_with():
    """Draw a motion for a robot in this process."""

    def drawn(robot, name):
        for message in strokes(name):
            points = [tuple(point) for point in message["points"]]
            more = {"source": "drawn", "follow": False, "received": time.monotonic()}
            robot.take({**message, "points": points, **more})

    return drawn
