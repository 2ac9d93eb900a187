"""The caregiver: how sequences of primitives are shown."""

from motionese.caregiver.demonstration import Caregiver, Demonstration
from motionese.caregiver.recorded_caregiver import (
    DEMONSTRATIONS,
    Recorded,
    RecordedCaregiver,
    read_recorded,
    recording_of,
)
from motionese.caregiver.scripted_caregiver import Manner, ScriptedCaregiver
from motionese.caregiver.segmentation import (
    evenly_along,
    intended_way,
    rows_of_places,
    segmented,
    sequence_in,
    stroke_length,
)
from motionese.caregiver.tempo import lasting, moving

__all__ = [
    "DEMONSTRATIONS",
    "Caregiver",
    "Demonstration",
    "Manner",
    "Recorded",
    "RecordedCaregiver",
    "ScriptedCaregiver",
    "evenly_along",
    "intended_way",
    "lasting",
    "moving",
    "read_recorded",
    "recording_of",
    "rows_of_places",
    "segmented",
    "sequence_in",
    "stroke_length",
]
