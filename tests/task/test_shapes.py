"""What counts as a well-drawn shape."""

from itertools import pairwise

import numpy as np
import pytest

from motionese.task import SHAPES, Attempt

CORNERS = [SHAPES.position(name) for name in ("T", "LR", "LL", "T")]
TRIANGLE = np.concatenate([np.linspace(a, b, 30) for a, b in pairwise(CORNERS)])
SEQUENCE = SHAPES.sequence("T ↘←↗")


def drawn(path, sequence=SEQUENCE):
    return SHAPES.achieved(sequence, Attempt((0, 30, 60), TRIANGLE, path, {}))


def test_the_shown_line_has_no_error_whenever_its_points_are_drawn():
    assert drawn(TRIANGLE) == {"line_error_cm": 0.0, "closure_cm": 0.0}
    late = TRIANGLE[np.maximum(np.arange(len(TRIANGLE)) - 3, 0)]
    late[-1] = TRIANGLE[-1]
    assert drawn(late)["line_error_cm"] < 0.1


def test_a_line_beside_and_a_gap_are_measured():
    beside = drawn(TRIANGLE + np.array([0.01, 0, 0]))
    assert beside["line_error_cm"] == pytest.approx(1.0, rel=0.01)
    assert beside["closure_cm"] == pytest.approx(0.0, abs=1e-9)
    cut = drawn(TRIANGLE[np.minimum(np.arange(90), 59)])
    assert cut["closure_cm"] == pytest.approx(
        100 * np.linalg.norm(SHAPES.position("LL") - SHAPES.position("T"))
    )
    assert cut["line_error_cm"] > 0.5, "a side is missing"


def test_what_does_not_end_where_it_begins_has_no_closure():
    assert np.isnan(drawn(TRIANGLE, SHAPES.sequence("T ↘←"))["closure_cm"])
