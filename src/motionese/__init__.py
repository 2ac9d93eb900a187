"""Developmental imitation learning with multiple-timescale recurrent networks (MTRNN)."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from motionese.channels import Channel, Channels
    from motionese.interfaces.onnx_export import export_onnx
    from motionese.kinematics import Measures, measure
    from motionese.learning import (
        Fit,
        Motions,
        Progress,
        Recognition,
        RecognitionResult,
        Training,
        generate,
        generate_sequence,
        load,
        placed,
        read_for,
        recognise,
        recognise_online,
        save,
        split,
        train,
        train_ensemble,
    )
    from motionese.network import MTRNN, Level, grow

__all__ = [
    "MTRNN",
    "Channel",
    "Channels",
    "Fit",
    "Level",
    "Measures",
    "Motions",
    "Progress",
    "Recognition",
    "RecognitionResult",
    "Training",
    "export_onnx",
    "generate",
    "generate_sequence",
    "grow",
    "load",
    "measure",
    "placed",
    "read_for",
    "recognise",
    "recognise_online",
    "save",
    "split",
    "train",
    "train_ensemble",
]

__version__ = "0.1.0"

_ROOMS = {
    "channels": ("Channel", "Channels"),
    "interfaces.onnx_export": ("export_onnx",),
    "interfaces.estimator": ("MTRNNImitator",),
    "kinematics": ("Measures", "measure"),
    "network": ("MTRNN", "Level", "grow"),
}
"""Where public names are written if not in `learning`. `MTRNNImitator` needs an extra's package and
is not in `__all__`: `import *` asks for all."""


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for, so that the command line answers at once."""
    room = next((room for room, names in _ROOMS.items() if name in names), "learning")
    if room == "learning" and name not in __all__:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    return getattr(import_module(f"{__name__}.{room}"), name)


def __dir__() -> list[str]:
    return [*__all__, "MTRNNImitator", "__version__"]
