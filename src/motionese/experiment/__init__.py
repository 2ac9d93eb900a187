"""The experiment: settings, conditions, the imitation loop, runs that resume, many runs at once."""

from motionese.experiment.conditions import CONDITIONS, Condition, condition
from motionese.experiment.evaluation import imitate_new_motions, map_slow_states
from motionese.experiment.imitation_loop import imitate, imitation_loop
from motionese.experiment.learner import Experience, Learner
from motionese.experiment.reading import read_settings
from motionese.experiment.run import Run, go_through
from motionese.experiment.scene import Scene
from motionese.experiment.settings import Settings

__all__ = [
    "CONDITIONS",
    "Condition",
    "Experience",
    "Learner",
    "Run",
    "Scene",
    "Settings",
    "condition",
    "go_through",
    "imitate",
    "imitate_new_motions",
    "imitation_loop",
    "map_slow_states",
    "read_settings",
]
