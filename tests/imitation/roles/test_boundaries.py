"""Boundaries by pauses, by labels and inside networks whose levels are known."""

from dataclasses import replace

import numpy as np

from motionese.imitation.roles import boundaries_found, readings
from motionese.minimum_jerk import minimum_jerk


def pausing(demonstration):
    """The demonstration as a hand that goes aside, rests for two rows, and goes up."""
    done = minimum_jerk(np.minimum(np.arange(14) / 12, 1.0))
    seen = np.zeros((28, 2))
    seen[:14, 0], seen[14:, 0] = 0.3 * done, 0.3
    seen[14:, 1] = 0.3 * done
    return replace(demonstration, seen=seen)


def test_pauses_and_activity_are_compared_with_labels_and_each_other(lesson_of):
    lesson = lesson_of("separate")
    lesson = replace(lesson, demonstrations=tuple(map(pausing, lesson.demonstrations)))
    rows = boundaries_found(lesson, readings(lesson, lesson, lesson), 10.0)

    assert {row["source"] for row in rows} == {"pauses", "io", "cf", "cs"}
    for row in rows:
        assert row["true"] == "14" and row["true_n"] == 1
        if row["source"] == "pauses" or (row["source"], row["reference"]) == ("cf", "taught"):
            assert (row["found_n"], row["both_n"]) == (1, 1)
            assert abs(int(row["found"]) - 14) <= 1
        if row["source"] == "cf" and row["reference"] == "taught":
            assert (row["pauses_n"], row["both_pauses_n"]) == (1, 1)
