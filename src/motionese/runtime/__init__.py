"""Trained models in a robot's control loop; needs NumPy and nothing else."""

from motionese.runtime.belief import NONE
from motionese.runtime.control_loop import ControlLoop
from motionese.runtime.limits import Limits
from motionese.runtime.loading import load
from motionese.runtime.loop_report import Ending, LoopReport
from motionese.runtime.model import RuntimeModel, State
from motionese.runtime.online_recognition import OnlineRecognition, OnlineResult
from motionese.runtime.player import Player, Stepper
from motionese.runtime.schedule import Part

__all__ = [
    "NONE",
    "ControlLoop",
    "Ending",
    "Limits",
    "LoopReport",
    "OnlineRecognition",
    "OnlineResult",
    "Part",
    "Player",
    "RuntimeModel",
    "State",
    "Stepper",
    "load",
]
