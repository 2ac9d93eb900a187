"""How a motion is shown: speed, acceleration, pauses, pace, roundness, range, repetitiveness."""

from motionese.kinematics.definitions import MEASURES, Measure
from motionese.kinematics.measures import PAUSE_S, Measures, measure
from motionese.kinematics.movements import STILL, Movement, Pause
from motionese.kinematics.tracks import WINDOW_S, Track

__all__ = [
    "MEASURES",
    "PAUSE_S",
    "STILL",
    "WINDOW_S",
    "Measure",
    "Measures",
    "Movement",
    "Pause",
    "Track",
    "measure",
]
