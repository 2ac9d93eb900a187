"""A pen that draws for a robot in this process: what it understands, and the arm that follows."""

import json
from dataclasses import replace

import numpy as np
import pytest
from drawn import strokes

from motionese.imitation import Scene
from motionese.interfaces.page.messages import understood
from motionese.interfaces.page.robot import Robot
from motionese.teaching.session_folder import SessionFolder


@pytest.fixture
def robot(tmp_path, small_settings):
    """A robot that has experiences, and the list of what it tells."""
    folder = SessionFolder(tmp_path / "session")
    teaching, told = folder.begin("fresh", Scene(small_settings, 0)), []
    learner, rng = teaching.learner, np.random.default_rng(3)
    for motion in ("UR ↓", "UR ←"):
        state = rng.normal(0, 3, learner.network.size)
        values = np.full((14, len(learner.channels)), 0.5)
        learner = learner.experiencing(1, motion, values, state)
    teaching.return_to(replace(teaching.standing, learner=learner))
    return Robot(folder, teaching, told.append, stop_asked=lambda: False), told


def draw(robot, *, to_the_end=True, **down):
    """Draw a stroke as a page does; the robot understands after every message."""
    first, *others, up = strokes("UR ↓", size=3)
    for message in ({**first, **down}, *others, *([up] if to_the_end else [])):
        said = understood(json.dumps(message)).model_dump(by_alias=True)
        robot.take({**said, "received": 0.0})
        robot.pen.understand()


def of_kind(told, kind):
    return [message for message in told if message["type"] == kind]


@pytest.mark.slow
def test_every_learned_motion_and_none_have_a_share_while_the_pen_moves(robot):
    robot, told = robot
    draw(robot)
    understandings = of_kind(told, "understanding")
    assert len(understandings) > 10
    for message in understandings:
        assert [one["motion"] for one in message["belief"]] == ["UR ↓", "UR ←", "none of these"]
        shares = {one["motion"]: one["share"] for one in message["belief"]}
        assert sum(shares.values()) == pytest.approx(1, abs=1e-3)
        seen = [one["share"] for one in message["seen"]]
        assert len(seen) == 3 and seen == sorted(seen, reverse=True) and sum(seen) <= 1.001
        assert len(message["next"]) == 14
    assert {message["seen"][0]["motion"] for message in understandings[3:]} == {"UR ↓"}
    rows = [len(message["path"]) for message in understandings]
    assert rows == sorted(rows) and rows[-1] > 10
    (saw,), (verdict,) = of_kind(told, "saw"), of_kind(told, "verdict")
    assert saw["seen"] == verdict["seen"], "what was seen is told first"
    assert told.index(saw) < told.index(verdict)
    assert verdict["motion"] == verdict["seen"][0]["motion"] == "UR ↓"
    assert not verdict["claim"]["made"] and verdict["advice"] == "imitate"
    assert not of_kind(told, "frames")


def test_a_robot_without_experiences_tells_nothing_of_what_it_sees(robot):
    robot, told = robot
    standing = robot.teaching.standing
    bare = replace(standing.learner, experiences=())
    robot.teaching.return_to(replace(standing, learner=bare))
    draw(robot, follow=True)
    assert not of_kind(told, "understanding") and not of_kind(told, "frames")
    assert len(of_kind(told, "verdict")) == 1


def test_the_arm_follows_a_pen_that_asks_for_it_and_the_verdict_comes_as_ever(robot):
    robot, told = robot
    draw(robot, follow=True)
    frames = of_kind(told, "frames")
    begins = np.cumsum([0, *(len(message["poses"]) for message in frames)])
    assert [message["from"] for message in frames] == begins[:-1].tolist()
    assert [message["last"] for message in frames] == [False] * (len(frames) - 1) + [True]
    rows = len(of_kind(told, "understanding")[-1]["path"])
    assert begins[-1] == 2 * rows + 1, "two frames a row, and the row that it was late"
    assert {len(message["poses"]) for message in frames} == {
        len(message["activity"]["cf"]) for message in frames
    }
    kinds = [message["type"] for message in told]
    assert kinds.index("verdict") > max(i for i, kind in enumerate(kinds) if kind == "frames")
    robot.take({"type": "imitate"})
    robot.go_on()
    assert told[-1]["type"] == "frames" and told[-1]["from"] == 0


def test_the_arm_follows_one_drawing_and_not_the_next(robot):
    robot, told = robot
    draw(robot, follow=True, to_the_end=False)
    robot.take({"type": "left"})
    told.clear()
    draw(robot)
    assert of_kind(told, "understanding") and not of_kind(told, "frames")
