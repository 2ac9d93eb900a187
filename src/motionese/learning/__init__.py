"""Motions with masks, training, recognition of initial states, generation."""

from motionese.learning.diagnosis import Diagnosis, diagnose
from motionese.learning.ensemble import train_ensemble
from motionese.learning.fit import Fit
from motionese.learning.generation.chain import generate_sequence
from motionese.learning.generation.generate import activity, generate, placed
from motionese.learning.memory import Memory
from motionese.learning.model_recordings import read_for
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.motions import Motions
from motionese.learning.recognition.online import recognise_online, runtime_model
from motionese.learning.recognition.recognise import recognise, recognise_all
from motionese.learning.recognition.result import RecognitionResult
from motionese.learning.settings import Recognition, Training
from motionese.learning.split import split
from motionese.learning.status import Ending, Progress, Status
from motionese.learning.storage import load, read_fit, save, write_fit
from motionese.learning.training.train import train

__all__ = [
    "Batch",
    "Diagnosis",
    "Ending",
    "Fit",
    "Memory",
    "Motions",
    "Progress",
    "Recognition",
    "RecognitionResult",
    "Status",
    "Training",
    "activity",
    "diagnose",
    "generate",
    "generate_sequence",
    "load",
    "placed",
    "read_fit",
    "read_for",
    "recognise",
    "recognise_all",
    "recognise_online",
    "runtime_model",
    "save",
    "split",
    "train",
    "train_ensemble",
    "write_fit",
]
