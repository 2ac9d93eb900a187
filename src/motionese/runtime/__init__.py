"""Trained models in a robot's control loop; needs NumPy and nothing else."""

from motionese.runtime.limits import Limits
from motionese.runtime.loading import load
from motionese.runtime.loop import ControlLoop
from motionese.runtime.model import RuntimeModel
from motionese.runtime.parts import Part
from motionese.runtime.player import Player
from motionese.runtime.ran import Ended, Ran
from motionese.runtime.state import State
from motionese.runtime.step import Stepper

__all__ = [
    "ControlLoop",
    "Ended",
    "Limits",
    "Part",
    "Player",
    "Ran",
    "RuntimeModel",
    "State",
    "Stepper",
    "load",
]
