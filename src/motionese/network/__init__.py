"""The MTRNN: levels and wiring, a step, whole rollouts with their adjoint, growth, storage."""

from motionese.network.growth import grow
from motionese.network.levels import Level
from motionese.network.mtrnn import MTRNN, InitialIO
from motionese.network.prediction import Prediction, predict, read_out, variance_of
from motionese.network.rollout import rollout
from motionese.network.sensitivity import sensitivities
from motionese.network.step import step, stepper
from motionese.network.storage import read_network, write_network
from motionese.network.trained import Trained, network_of
from motionese.network.wiring import Scale, wiring

__all__ = [
    "MTRNN",
    "InitialIO",
    "Level",
    "Prediction",
    "Scale",
    "Trained",
    "grow",
    "network_of",
    "predict",
    "read_network",
    "read_out",
    "rollout",
    "sensitivities",
    "step",
    "stepper",
    "variance_of",
    "wiring",
    "write_network",
]
