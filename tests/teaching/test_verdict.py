"""How sure the verdict on a demonstration is."""

import numpy as np
import pytest

from motionese.caregiver import intended_way, lasting
from motionese.task import PUSHING_BUTTONS, SHAPES
from motionese.teaching.recogniser import start_of
from motionese.teaching.verdict import confidence, verdict_on

KNOWN = ["babbling", "UR ?", "UR ↓"]


def path_of(name, task=PUSHING_BUTTONS):
    return intended_way(task.sequence(name), task)


def verdict(shown, understood, task=PUSHING_BUTTONS):
    return verdict_on(path_of(shown, task), path_of(understood, task), task, KNOWN)


def test_the_right_sequence_is_sure():
    sure = verdict("UR ↓↑", "UR ↓↑")
    assert sure.recognised == sure.shown == PUSHING_BUTTONS.sequence("UR ↓↑")
    assert sure.confidence > 0.9 and sure.error_cm == pytest.approx(0, abs=1e-9)
    assert sure.sentence == "I understood: from the upper right down, then up."


def test_an_arc_is_told_from_the_straight_way_between_the_same_places():
    sure = verdict("T ◝◡", "T ◝◡", SHAPES)
    assert sure.recognised == sure.shown == SHAPES.sequence("T ◝◡")
    assert sure.confidence > 2 * sure.alternatives[0][1]
    unsure = verdict("T ↘", "T ◝", SHAPES)
    assert unsure.shown == SHAPES.sequence("T ↘") and unsure.recognised == SHAPES.sequence("T ◝")
    assert unsure.confidence < sure.confidence


def test_to_understand_something_else_than_was_shown_is_not_sure():
    wrong = verdict("UR ↓", "UR ←")
    assert wrong.recognised != wrong.shown and wrong.error_cm > 5
    assert wrong.confidence < 0.9, "no candidate is near to both"
    assert "I understood" not in wrong.sentence


def test_confidences_are_the_softmax_that_is_described():
    down, left = (PUSHING_BUTTONS.sequence(name) for name in ("UR ↓", "UR ←"))
    middle = (path_of("UR ↓") + path_of("UR ←")) / 2
    shares = confidence([down, left], middle, middle, PUSHING_BUTTONS)
    assert sum(shares) == pytest.approx(1) and shares[0] == pytest.approx(0.5, abs=0.2)
    nearer = 0.8 * path_of("UR ↓") + 0.2 * path_of("UR ←")
    assert confidence([down, left], nearer, nearer, PUSHING_BUTTONS)[0] > 0.99


def test_an_unreadable_path_is_admitted():
    start = PUSHING_BUTTONS.position("UR")
    nowhere = lasting(np.stack([start, start + np.array([0, 0, 0.03])]), 10)
    said = verdict_on(nowhere, nowhere, PUSHING_BUTTONS, [])
    assert said.recognised is None and said.confidence == 0
    assert "upper right" in said.sentence and "do not know" in said.sentence


@pytest.mark.parametrize("task", [PUSHING_BUTTONS, SHAPES], ids=lambda task: task.name)
def test_a_path_starts_at_the_nearest_place(task):
    for sequence in task.sequences(2):
        path = intended_way(sequence, task)
        assert start_of(path + 0.01, task).start == sequence.start
