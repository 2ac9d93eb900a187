"""Imitation: a scene, performances, a learner, the loop, its development and its measures."""

from motionese.imitation.choosing import Choosing
from motionese.imitation.development import Development, Stage
from motionese.imitation.emergence import share_emerged
from motionese.imitation.evaluation import imitate_novel, kept_of, sample_sequence
from motionese.imitation.following import follow, followed, recognised_while_shown
from motionese.imitation.initial_state_map import (
    has_map,
    map_slow_states,
    strokes_from,
)
from motionese.imitation.keys import generator_for, key_for
from motionese.imitation.learner import (
    BABBLING,
    Experience,
    Learner,
    babbled,
    newborn,
    read_learner,
    write_learner,
)
from motionese.imitation.loop import Imitation, Row, imitate, imitation_loop, network_row
from motionese.imitation.measures import path_error_cm, seen_error_cm
from motionese.imitation.performance import Performance, Trial, Watched, babble, perform, watch
from motionese.imitation.readiness import Emerged, LoopDone, Mastered, Settled, Until
from motionese.imitation.roles.tables import role_tables
from motionese.imitation.scene import Recordings, Scene
from motionese.imitation.settings import Group, Settings, checked, setting_names
from motionese.imitation.switching import Switch, sequence_of, switched

__all__ = [
    "BABBLING",
    "Choosing",
    "Development",
    "Emerged",
    "Experience",
    "Group",
    "Imitation",
    "Learner",
    "LoopDone",
    "Mastered",
    "Performance",
    "Recordings",
    "Row",
    "Scene",
    "Settings",
    "Settled",
    "Stage",
    "Switch",
    "Trial",
    "Until",
    "Watched",
    "babble",
    "babbled",
    "checked",
    "follow",
    "followed",
    "generator_for",
    "has_map",
    "imitate",
    "imitate_novel",
    "imitation_loop",
    "kept_of",
    "key_for",
    "map_slow_states",
    "network_row",
    "newborn",
    "path_error_cm",
    "perform",
    "read_learner",
    "recognised_while_shown",
    "role_tables",
    "sample_sequence",
    "seen_error_cm",
    "sequence_of",
    "setting_names",
    "share_emerged",
    "strokes_from",
    "switched",
    "watch",
    "write_learner",
]
