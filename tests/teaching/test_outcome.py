"""Whether buttons were pressed is said in words."""

import numpy as np
import pytest

from motionese.imitation import Performance
from motionese.task import PUSHING_BUTTONS, SHAPES
from motionese.teaching.outcome import pressed


def performance(effects):
    """Two rows in which nothing is told but effects."""
    rows = {name: np.zeros((2, 2)) for name in ("sensed", "commanded", "predicted", "potentials")}
    path, poses = np.zeros((2, 3)), np.zeros((2, 1))
    return Performance(**rows, path=path, effects=effects, poses=poses, joints=(0, 1))


@pytest.mark.parametrize(
    ("motion", "right", "left", "said"),
    [
        ("UR ↓", 6.0, 0.0, "it pressed the right button"),
        ("UR ↓", 4.2, 9.0, "it did not press the right button (4.2 of 5 mm)"),
        ("UR ←↓", 6.0, 7.0, "it pressed the left button"),
        ("UR ←", 6.0, 0.0, ""),
    ],
)
def test_due_presses_are_told(motion, right, left, said):
    effects = {"right_button": np.array([0.0, right]), "left_button": np.array([left, 0.0])}
    done = performance(effects)
    assert pressed(done, PUSHING_BUTTONS, PUSHING_BUTTONS.sequence(motion)) == said


def test_nothing_is_told_of_what_asks_for_no_press():
    done = performance({})
    assert pressed(done, PUSHING_BUTTONS, None) == ""
    assert pressed(done, SHAPES, SHAPES.sequences(1)[0]) == ""
