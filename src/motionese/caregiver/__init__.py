"""The caregiver: how sequences of primitives are shown."""

from motionese.caregiver.demonstration import Caregiver, Demonstration
from motionese.caregiver.hypotheses import SOMETHING_ELSE, hypotheses, sequence_in
from motionese.caregiver.motionese import FULL, Motionese
from motionese.caregiver.recorded_caregiver import (
    DEMONSTRATIONS,
    Recorded,
    RecordedCaregiver,
    read_recorded,
    recording_of,
)
from motionese.caregiver.scripted_caregiver import Manner, ScriptedCaregiver, check_reach
from motionese.caregiver.segmentation import rows_of_places, segmented
from motionese.caregiver.tempo import lasting, moving
from motionese.caregiver.ways import evenly_along, intended_way, stroke_length

__all__ = [
    "DEMONSTRATIONS",
    "FULL",
    "SOMETHING_ELSE",
    "Caregiver",
    "Demonstration",
    "Manner",
    "Motionese",
    "Recorded",
    "RecordedCaregiver",
    "ScriptedCaregiver",
    "check_reach",
    "evenly_along",
    "hypotheses",
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
