"""Developmental imitation learning with multiple-timescale recurrent networks (MTRNN)."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from motionese.channels import Channel, Channels
    from motionese.learning import (
        Fit,
        Found,
        Motions,
        Recognition,
        Training,
        generate,
        load,
        recognise,
        save,
        train,
    )
    from motionese.network import MTRNN, Level, grow

__all__ = [
    "MTRNN",
    "Channel",
    "Channels",
    "Fit",
    "Found",
    "Level",
    "Motions",
    "Recognition",
    "Training",
    "generate",
    "grow",
    "load",
    "recognise",
    "save",
    "train",
]

__version__ = "0.1.0"

_ROOMS = {"channels": ("Channel", "Channels"), "network": ("MTRNN", "Level", "grow")}


def __getattr__(name: str) -> Any:
    """Import a public name when it is first asked for, so that the command line answers at once."""
    if name not in __all__:
        raise AttributeError(f"module '{__name__}' has no attribute '{name}'")
    room = next((room for room, names in _ROOMS.items() if name in names), "learning")
    return getattr(import_module(f"{__name__}.{room}"), name)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
