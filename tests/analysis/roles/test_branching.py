"""Where lessons branch, counted by hand."""

import numpy as np
import pytest

from motionese.analysis.roles.branching import (
    NO_BRANCH,
    NO_CHOICE,
    branch_chance,
    branches,
    ways_on,
    without_cases,
)
from motionese.task import PUSHING_BUTTONS


def lesson(*names):
    return PUSHING_BUTTONS.lesson(names)


def test_the_papers_pairs_do_not_branch():
    pairs = PUSHING_BUTTONS.lesson("taught pairs")
    assert branches(pairs) == {} and ways_on(pairs) == {}
    assert np.isnan(branch_chance(pairs))
    assert without_cases(pairs) == [NO_BRANCH]


def test_a_lesson_that_branches_after_its_first_stroke():
    branching = PUSHING_BUTTONS.lesson("branching")
    ways = ("UR ←", "UR ↓")
    assert branches(branching) == {("LR ↑↓", 2): ways, ("LR ↑←", 2): ways}
    assert ways_on(branching) == {"LR ↑": ways}
    assert branch_chance(branching) == 0.5
    assert without_cases(branching) == []


def test_a_lesson_that_branches_later():
    later = lesson("UR ↓↑←", "UR ↓↑↓", "LL ↑")
    assert set(branches(later)) == {("UR ↓↑←", 3), ("UR ↓↑↓", 3)}
    assert ways_on(later) == {}
    assert without_cases(later) == [NO_CHOICE]


def test_a_motion_that_ends_where_another_goes_on_is_no_branch():
    assert branches(lesson("LR ↑", "LR ↑←")) == {}


@pytest.mark.parametrize("names", [("UR ↓",), ("UR ↓", "LL ↑")])
def test_motions_that_have_nothing_in_common(names):
    assert without_cases(lesson(*names)) == [NO_CHOICE, NO_BRANCH]
