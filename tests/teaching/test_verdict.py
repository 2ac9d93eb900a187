"""The verdict: what was seen and whether it can be done, in words, and the advice."""

from dataclasses import replace

import numpy as np
import pytest

from motionese.caregiver import SOMETHING_ELSE, intended_way
from motionese.task import PUSHING_BUTTONS, SHAPES
from motionese.teaching.claim import FORETOLD_CM, Claim
from motionese.teaching.recogniser import start_of
from motionese.teaching.result import WELL_CM, Push, Result
from motionese.teaching.verdict import Verdict, seen_in_words

PRESSED = Push("right_button", "LR", 6.1, 5.0)
MISSED = Push("right_button", "LR", 4.2, 5.0)
OWN = "your motion 1"


def claim(foretold=1.0, expected=1.0, missed=(), tried=None):
    return Claim(foretold, expected, missed, "UR ↓", 0.1, tried)


def words(seen, motion, learned=()):
    return seen_in_words(seen, motion, PUSHING_BUTTONS, learned)


def advice(tried):
    return Verdict({"UR ↓": 1.0}, "UR ↓", None, 0.0, claim(tried=tried), "").advice


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({}, "I can do this."),
        ({"foretold": FORETOLD_CM + 0.1}, "it went on 5.1 cm from what I expected"),
        ({"expected": WELL_CM + 0.1}, "I expect to miss by 2.1 cm"),
        ({"expected": np.inf}, "I have never moved"),
        ({"missed": ("LL",)}, "I expect to miss LL"),
        ({"tried": Result(1.0, (PRESSED,))}, "I can do this."),
        ({"tried": Result(1.0, (MISSED,))}, "my last try pressed LR 4.2 mm; 5"),
        ({"tried": Result(4.0)}, "my last try missed by 4.0 cm"),
    ],
)
def test_a_claim_is_made_only_where_nothing_speaks_against_it(given, said):
    made = claim(**given)
    assert said in made.sentence and made.made == ("I can" in said)


def test_a_result_says_how_near_it_came_and_what_it_pressed():
    pressed, missed = Result(1.0, (PRESSED,)), Result(1.0, (PRESSED, MISSED))
    assert pressed.good and not missed.good and not Result(WELL_CM + 0.1).good
    assert "pressed LR: 6.1 mm of the 5 it needs" in pressed.sentence
    assert "does this well" in pressed.sentence and "does this well" not in missed.sentence
    assert "4.2 mm; 5 are needed" in missed.sentence
    untouched = Result(4.0, (replace(MISSED, depth_mm=0.0),))
    assert untouched.sentence.endswith(f"and did not press {MISSED.place}.")
    assert Result(3.0).sentence == "It missed by 3.0 cm."


def test_what_was_seen_is_told_as_surely_as_it_is():
    down = "from UR down"
    assert words({"UR ↓": 0.9, SOMETHING_ELSE: 0.1}, "UR ↓") == f"I saw: {down}."
    assert words({"UR ↓": 0.6, SOMETHING_ELSE: 0.4}, "UR ↓") == f"I think I saw: {down}."
    assert words({SOMETHING_ELSE: 0.9}, OWN).endswith(f"I call it {OWN}.")
    assert words({OWN: 0.9}, OWN) == f"I saw {OWN}, which I saw before."
    assert words({OWN: 0.9}, OWN, [OWN]) == f"I saw {OWN}, which I have learned."


def test_a_try_that_failed_is_no_reason_to_try_again():
    assert advice(None) == advice(Result(1.0)) == "imitate"
    assert advice(Result(4.0)) == advice(Result(1.0, (MISSED,))) == "learn"


@pytest.mark.parametrize("task", [PUSHING_BUTTONS, SHAPES], ids=lambda task: task.name)
def test_a_path_starts_at_the_nearest_place(task):
    for sequence in task.sequences(2):
        path = intended_way(sequence, task)
        assert start_of(path + 0.01, task).start == sequence.start
