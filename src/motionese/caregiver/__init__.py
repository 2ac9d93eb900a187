"""The caregiver: how sequences of primitives are shown."""

from motionese.caregiver.demonstration import (
    Caregiver,
    Demonstration,
    RecordedCaregiver,
    rows_of_places,
)
from motionese.caregiver.scripted import Manner, ScriptedCaregiver

__all__ = [
    "Caregiver",
    "Demonstration",
    "Manner",
    "RecordedCaregiver",
    "ScriptedCaregiver",
    "rows_of_places",
]
