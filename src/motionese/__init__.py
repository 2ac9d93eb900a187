"""Developmental imitation learning with multiple-timescale recurrent networks (MTRNN)."""

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
