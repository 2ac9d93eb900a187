"""The caregiver: the task, what is taught in which phase, and how a motion is shown."""

from motionese.caregiver.curriculum import Curriculum
from motionese.caregiver.demonstration import (
    Caregiver,
    Demonstrating,
    RecordedCaregiver,
    ScriptedCaregiver,
)
from motionese.caregiver.task import BUTTONS, PUSHING_BUTTONS, Motion, Primitive, Task

__all__ = [
    "BUTTONS",
    "PUSHING_BUTTONS",
    "Caregiver",
    "Curriculum",
    "Demonstrating",
    "Motion",
    "Primitive",
    "RecordedCaregiver",
    "ScriptedCaregiver",
    "Task",
]
