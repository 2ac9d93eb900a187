"""Trained models in a robot's control loop; needs NumPy and nothing else."""

from motionese.runtime.control_loop import ControlLoop
from motionese.runtime.limits import Limits
from motionese.runtime.loading import load
from motionese.runtime.loop_report import Ending, LoopReport
from motionese.runtime.model import RuntimeModel, State
from motionese.runtime.player import Player, Stepper
from motionese.runtime.schedule import Part

__all__ = [
    "ControlLoop",
    "Ending",
    "Limits",
    "LoopReport",
    "Part",
    "Player",
    "RuntimeModel",
    "State",
    "Stepper",
    "load",
]
