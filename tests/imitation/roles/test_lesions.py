"""Lesions tell the networks written by hand apart, and do not touch what they do not meet."""

from dataclasses import replace

import numpy as np
import pytest
from by_hand.role_networks import MOTIONS

from motionese.imitation.roles import lesioned

RIGHT = {
    "separate": {
        "none": (1.0, 1.0),
        "cf_0 to its mean": (0.5, 1.0),
        "cs_0 to its mean": (1.0, 0.5),
        "cs → cf cut": (1.0, 0.5),
    },
    "all_in_cf": {
        "none": (1.0, 1.0),
        "cf_0 to its mean": (0.5, 0.5),
        "cs_0 to its mean": (1.0, 1.0),
        "cs → cf cut": (1.0, 1.0),
    },
    "all_in_cs": {
        "none": (1.0, 1.0),
        "cf_0 to its mean": (1.0, 1.0),
        "cs_0 to its mean": (0.5, 0.5),
        "cs → cf cut": (0.5, 0.5),
    },
}
"""Shares of first and of second strokes that are right, by lesion."""


@pytest.mark.parametrize("name", RIGHT)
def test_a_lesion_takes_what_its_level_decides(lesson_of, name):
    rows = lesioned(lesson_of(name))
    shares = {
        lesion: tuple(
            np.mean(
                [row["right"] for row in rows if (row["lesion"], row["stroke"]) == (lesion, stroke)]
            )
            for stroke in (1, 2)
        )
        for lesion in RIGHT[name]
    }
    assert shares == RIGHT[name]
    assert len(rows) == 4 * len(MOTIONS) * 2 * 2


def test_a_row_tells_what_was_done_to_which_stroke(lesson_of):
    assert lesioned(lesson_of("separate"))[:2] == [
        {
            "motion": "middle →↑",
            "demonstration": 1,
            "lesion": "none",
            "stroke": stroke,
            "ambiguous": True,
            "right": True,
        }
        for stroke in (1, 2)
    ]


def test_a_stroke_is_ambiguous_where_another_motion_goes_on_otherwise(lesson_of):
    lesson = lesson_of("separate", motions=[("right", "up"), ("left", "up"), ("left", "down")])
    told = {(row["motion"], row["stroke"]): row["ambiguous"] for row in lesioned(lesson)}
    assert {where for where, ambiguous in told.items() if not ambiguous} == {("middle →↑", 2)}
    assert len(told) == 6


def test_a_lesson_of_one_motion_gives_no_rows(lesson_of):
    assert lesioned(lesson_of("separate", motions=MOTIONS[:1])) == []


def test_what_was_not_recognised_neither_counts_nor_enters_the_mean(lesson_of):
    lesson = lesson_of("separate")
    lost = lesson.demonstrations[0]
    nothing = replace(lost, initial_state=np.full_like(lost.initial_state, np.nan))
    lessened = replace(lesson, demonstrations=(nothing, *lesson.demonstrations[1:]))
    without = replace(lesson, demonstrations=lesson.demonstrations[1:])
    assert lesioned(lessened) == lesioned(without)
