"""How a person shows a motion, measured, beside how the scripted caregiver would show the same.

The measures are those of `motionese.kinematics`, of the drawing as it went in time. The scripted
caregiver is measured without its unsteadiness: as to an adult, and with the motionese of the
session's settings at its full strength, or, where they emphasise nothing, all of it.
"""

from collections.abc import Mapping
from dataclasses import dataclass

from motionese.caregiver import FULL, ScriptedCaregiver
from motionese.imitation import Scene
from motionese.kinematics import Measures, measure
from motionese.task import PrimitiveSequence
from motionese.teaching.corners import Corner, corners_of
from motionese.teaching.notebook import Entry
from motionese.teaching.verdict import sequence_called

YOU, ADULT, MOTIONESE = "you", "adult", "motionese"


@dataclass(frozen=True)
class ShownManner:
    """How a motion is shown.

    Attributes:
        measures: By who shows it: `YOU`, if a person did; the scripted caregiver to an `ADULT` and
            with `MOTIONESE`, if the motion is a sequence of the task.
        corners: The corners between the strokes that a person drew, of a sequence of the task.
    """

    measures: Mapping[str, Measures]
    corners: tuple[Corner, ...]


def shown_manner(entry: Entry, scene: Scene) -> ShownManner:
    """Return how an entry of the notebook was shown, beside the scripted caregiver."""
    sequence, rate_hz = sequence_called(entry.motion, scene.task), scene.body.rate_hz
    theirs = _scripted(sequence, scene) if sequence else {}
    if entry.source == "scripted":
        return ShownManner(theirs, ())
    own = measure(entry.drawn, rate_hz)
    corners = corners_of(sequence, entry.drawn, own.pauses, rate_hz, scene.task) if sequence else ()
    return ShownManner({YOU: own, **theirs}, corners)


def _scripted(sequence: PrimitiveSequence, scene: Scene) -> dict[str, Measures]:
    """Return the measures of the scripted caregiver, to an adult and with motionese."""
    wanted = scene.settings.caregiver.motionese.at(1, None)
    emphasis = wanted if wanted.emphasises else FULL
    manner = scene.settings.caregiver.to_adults()
    manners = {ADULT: manner, MOTIONESE: manner.model_copy(update={"motionese": emphasis})}
    return {
        name: measure(
            ScriptedCaregiver(scene.task, each, scene.body).intended(sequence), scene.body.rate_hz
        )
        for name, each in manners.items()
    }
