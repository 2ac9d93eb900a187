"""Chapters and names as the page meets them: told, kept in the folder, and never in the way."""

import numpy as np
import pytest

from motionese.caregiver import lasting
from motionese.teaching.session_folder import SessionFolder


def last(told, kind):
    return next(each for each in reversed(told) if each["type"] == kind)


@pytest.mark.slow
def test_a_new_robot_goes_on_with_the_chapters_of_the_one_before(
    robot, told, does, draw_with, tmp_path
):
    assert last(told, "session")["chapter"] == {
        **{"name": "push", "number": 1, "of": 5, "title": "Show it a push"},
        **{"act": "show", "motion": "UL ↓"},
    }
    draw_with(robot, "UR ↓")
    assert last(told, "session")["chapter"]["title"] == "Watch it fail"
    does("imitate")
    does("begin", **{"with": "fresh", "grows": "told", "name": "", "away": ""})
    chapter = last(told, "session")["chapter"]
    assert (chapter["number"], chapter["act"], chapter["motion"]) == (3, "show", "UL ↓")
    assert SessionFolder(tmp_path / "session" / "robot-2").read().notebook.ended == {"push", "try"}


@pytest.mark.slow
def test_a_point_of_the_map_ends_the_last_chapter_and_a_name_is_on_the_map(
    robot, told, does, tmp_path
):
    scene = robot.teaching.scene
    ends = [scene.task.position(name) for name in ("UR", "LL")]
    path = scene.body.reachable(lasting(np.stack(ends), 20))
    robot.teaching.show(path, "drawn")
    for kind in ("imitate", "learn", "map"):
        does(kind)
    does("rename", motion="your motion 1", name="wave")
    assert last(told, "verdict")["motion"] == "wave"
    (entry,) = last(told, "session")["notebook"]
    assert (entry["motion"], entry["own"]) == ("wave", True)
    assert {point["motion"] for point in last(told, "map")["points"]} <= {"wave"}
    does("rename", motion="wave", name="UR ↓")
    assert "choose another name" in last(told, "told")["sentence"]
    for at in (0.0, 0.5, 0.5, 1.0):
        assert "map" not in SessionFolder(tmp_path / "session").read().notebook.ended
        robot.take({"type": "hover", "slow": (at, 0.0), "primitive": "UR ↓"})
    assert "map" in SessionFolder(tmp_path / "session").read().notebook.ended
