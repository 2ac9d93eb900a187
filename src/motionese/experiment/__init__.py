"""Studies: conditions, stages, presets, runs that resume, many runs at once, their folders."""

from motionese.experiment.conditions import Condition, condition_named, conditions_of
from motionese.experiment.lessons import StageLesson, stage_lessons
from motionese.experiment.presets import read_settings
from motionese.experiment.run import Run, go_through
from motionese.experiment.study import StageSettings, Study

__all__ = [
    "Condition",
    "Run",
    "StageLesson",
    "StageSettings",
    "Study",
    "condition_named",
    "conditions_of",
    "go_through",
    "read_settings",
    "stage_lessons",
]
