"""Reading paths as motions, and how sure the verdict is."""

import numpy as np
import pytest

from motionese.body import CORNERS
from motionese.caregiver import PUSHING_BUTTONS
from motionese.experiment.perform import Watched
from motionese.teaching.drawing import lasting
from motionese.teaching.reading import arrows_passed, corners_passed, in_words, motion_read
from motionese.teaching.recognising import Understood
from motionese.teaching.verdict import confidence, judged

MOTIONS = [m for length in (1, 2, 3) for m in PUSHING_BUTTONS.sequences(length)]


def path_of(name, scene):
    return scene.caregiver.intended(PUSHING_BUTTONS.motion(name))


def verdict(shown, understood, scene):
    path = path_of(understood, scene)
    watched = Watched(np.zeros((len(path), 6)), lasting(path_of(shown, scene), len(path)))
    found = Understood(0, np.zeros(1), np.zeros(6), path, path[:0])
    return judged(watched, found, scene.settings.caregiver, ["babbling", "UR ?", "UR ↓"])


@pytest.mark.parametrize("motion", MOTIONS, ids=lambda m: m.name)
def test_every_motion_is_read_from_its_path(motion, scene):
    assert motion_read(scene.caregiver.intended(motion), CORNERS) == motion


def test_what_the_task_does_not_allow_is_no_motion():
    diagonal = lasting(np.stack([CORNERS["UR"], CORNERS["LL"]]), 20)
    assert corners_passed(diagonal, CORNERS) == ("UR", "LL")
    assert motion_read(diagonal, CORNERS) is None
    assert arrows_passed(diagonal, CORNERS) == "UR"


def test_arrows_appear_as_strokes_are_completed(scene):
    path = path_of("UR ↓↑←", scene)
    said = [arrows_passed(path[:rows], CORNERS) for rows in (3, 14, 28, 42)]
    assert said == ["UR", "UR ↓", "UR ↓↑", "UR ↓↑←"]


def test_the_right_motion_is_sure(scene):
    sure = verdict("UR ↓↑", "UR ↓↑", scene)
    assert sure.motion == sure.shown == PUSHING_BUTTONS.motion("UR ↓↑")
    assert sure.confidence > 0.9 and sure.error_cm == pytest.approx(0, abs=1e-9)
    assert sure.sentence == "I understood: from the upper right down, then up."


def test_to_understand_something_else_than_was_shown_is_not_sure(scene):
    wrong = verdict("UR ↓", "UR ←", scene)
    assert wrong.motion != wrong.shown and wrong.error_cm > 5
    assert wrong.confidence < 0.9, "no candidate is near to both"
    assert "I understood" not in wrong.sentence


def test_confidences_are_the_softmax_that_is_described(scene):
    down, left = (PUSHING_BUTTONS.motion(name) for name in ("UR ↓", "UR ←"))
    middle = (path_of("UR ↓", scene) + path_of("UR ←", scene)) / 2
    shares = confidence([down, left], middle, middle, CORNERS)
    assert sum(shares) == pytest.approx(1) and shares[0] == pytest.approx(0.5, abs=0.2)
    nearer = 0.8 * path_of("UR ↓", scene) + 0.2 * path_of("UR ←", scene)
    assert confidence([down, left], nearer, nearer, CORNERS)[0] > 0.99


def test_an_unreadable_path_is_admitted(scene):
    nowhere = lasting(np.stack([CORNERS["UR"], CORNERS["UR"] + [0, 0, 0.03]]), 10)
    watched = Watched(np.zeros((10, 6)), nowhere)
    found = Understood(0, np.zeros(1), np.zeros(6), nowhere, nowhere[:0])
    said = judged(watched, found, scene.settings.caregiver, [])
    assert said.motion is None and said.confidence == 0
    assert "upper right" in said.sentence and "do not know" in said.sentence


def test_motions_are_told_in_words():
    assert in_words(PUSHING_BUTTONS.motion("LL ↑↓")) == "from the left button up, then down"
