"""Motions with masks, training, recognition of initial states, generation."""

from motionese.learning.batch import Batch
from motionese.learning.fit import Fit
from motionese.learning.found import Found
from motionese.learning.generate import activity, generate
from motionese.learning.model_recordings import read_for
from motionese.learning.motions import Motions
from motionese.learning.placed import placed
from motionese.learning.progress import Progress
from motionese.learning.recognise import recognise, recognise_all
from motionese.learning.sequence import generate_sequence
from motionese.learning.settings import Recognition, Training
from motionese.learning.split import split
from motionese.learning.status import Ending, Status
from motionese.learning.storage import load, read_fit, save, write_fit
from motionese.learning.train import train

__all__ = [
    "Batch",
    "Ending",
    "Fit",
    "Found",
    "Motions",
    "Progress",
    "Recognition",
    "Status",
    "Training",
    "activity",
    "generate",
    "generate_sequence",
    "load",
    "placed",
    "read_fit",
    "read_for",
    "recognise",
    "recognise_all",
    "save",
    "split",
    "train",
    "write_fit",
]
