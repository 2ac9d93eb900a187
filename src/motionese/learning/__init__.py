"""Motions with masks, training, recognition of initial states, generation."""

from motionese.learning.generate import activity, generate
from motionese.learning.motions import Batch, Motions
from motionese.learning.recognise import Found, recognise, recognise_all
from motionese.learning.settings import Recognition, Training
from motionese.learning.status import Ending, Status
from motionese.learning.storage import load, save
from motionese.learning.train import Fit, train

__all__ = [
    "Batch",
    "Ending",
    "Fit",
    "Found",
    "Motions",
    "Recognition",
    "Status",
    "Training",
    "activity",
    "generate",
    "load",
    "recognise",
    "recognise_all",
    "save",
    "train",
]
