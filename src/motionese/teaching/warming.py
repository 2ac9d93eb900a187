"""Everything compiled before a person waits for it: once through all that a drawing asks for."""

from motionese.caregiver import PUSHING_BUTTONS
from motionese.experiment.keys import generator_for
from motionese.learning import activity
from motionese.teaching.drawing import most_rows
from motionese.teaching.session import Teaching


def warm(teaching: Teaching) -> None:
    """Recognise, judge and perform a motion that nobody sees."""
    scene, network = teaching.scene, teaching.learner.network
    motion = PUSHING_BUTTONS.sequences(1)[0]
    path = scene.caregiver.demonstrate(motion, generator_for(0, "warming"))
    watched = teaching.watch(path)
    understood = teaching.recogniser.so_far(watched, None)
    state = teaching.recogniser.at_the_end(watched, understood).state
    performance = scene.perform(network, state, motion, 3, "warming")
    steps = most_rows(scene.settings.caregiver)
    activity(network, state, steps, first=performance.sensed[0])
