"""More robots than one, as a page meets them: begun, switched, named, taught alike, compared."""

import time

import pytest
from drawn import strokes

from motionese.imitation import Scene
from motionese.interfaces.page.robot import Robot, open_session
from motionese.teaching.packed_session import pack, unpack
from motionese.teaching.session_contents import OPENED
from motionese.teaching.session_folder import SessionFolder

NUMBER = 32 * "a"


@pytest.fixture
def told():
    """What the page is told."""
    return []


@pytest.fixture
def robot(tmp_path, small_settings, told):
    """A robot that knows nothing."""
    folder = SessionFolder(tmp_path / "session")
    teaching = folder.begin("fresh", Scene(small_settings, 0))
    robot = Robot(folder, teaching, told.append, stop_asked=lambda: False)
    robot.tell_session()
    return robot


def done(robot, kind, /, **more):
    """Let a robot do what a message says, to the end."""
    robot.take({"type": kind, **more})
    while robot.going is not None:
        robot.go_on()


def begun(robot, **more):
    done(robot, "begin", **{"with": "fresh", "grows": "told", "name": "", "away": "", **more})


def shown(robot, name):
    for message in strokes(name):
        more = {"source": "drawn", "follow": False, "received": time.monotonic()}
        robot.take({**message, "points": [tuple(p) for p in message["points"]], **more})


def last(told, kind):
    return [message for message in told if message["type"] == kind][-1]


def said(told):
    return [message["sentence"] for message in told if message["type"] == "told"]


@pytest.mark.slow
def test_robots_are_begun_switched_and_named(robot, told):
    first = last(told, "robots")["taught"]
    begun(robot, grows="beginning")
    begun(robot, grows="never", name="Never")
    robots = last(told, "robots")
    assert [(r["name"], r["grows"], r["levels"], r["lessons"]) for r in robots["robots"]] == [
        ("Robot 1", "told", ["io", "cf"], 0),
        ("Robot 2", "beginning", ["io", "cf", "cs"], 0),
        ("Never", "never", ["io", "cf"], 0),
    ]
    third = robots["taught"]
    assert third == robots["robots"][2]["id"] == last(told, "session")["id"]
    assert not last(told, "session")["can_grow"] and "teaching Never" in said(told)[-1]
    shown(robot, "UR ↓")
    done(robot, "teach", robot=first)
    assert last(told, "robots")["taught"] == first == last(told, "session")["id"]
    assert last(told, "session")["notebook"] == [] and last(told, "session")["busy"] == ""
    kinds = [message["type"] for message in told]
    assert kinds.index("begun") < len(kinds) - 1
    done(robot, "teach", robot=third)
    assert [e["motion"] for e in last(told, "session")["notebook"]] == ["UR ↓"]
    done(robot, "call", robot=first, name="Early")
    assert last(told, "robots")["robots"][0]["name"] == "Early"
    done(robot, "teach", robot="nobody")
    assert "not in the session" in said(told)[-1]


def test_a_fourth_needs_the_place_of_another(robot, told):
    first = last(told, "robots")["taught"]
    begun(robot), begun(robot)
    begun(robot)
    assert "choose the one to be put away" in said(told)[-1]
    assert len(last(told, "robots")["robots"]) == last(told, "robots")["most"] == 3
    begun(robot, away=first)
    assert "Robot 1 is put away" in said(told)[-1]
    assert first not in [r["id"] for r in last(told, "robots")["robots"]]
    assert last(told, "session")["busy"] == ""


@pytest.mark.slow
def test_another_robot_has_the_same_lessons(robot, told):
    first = last(told, "robots")["taught"]
    for name in ("UR ↓", "UR ←"):
        shown(robot, name)
        done(robot, "learn")
    begun(robot, grows="never")
    assert [r["left"] for r in last(told, "robots")["robots"]] == [2, 0]
    done(robot, "repeat", robot=first)
    notebook = last(told, "session")["notebook"]
    assert [(e["motion"], len(e["errors"]) > 5) for e in notebook] == [
        ("UR ↓", True),
        ("UR ←", True),
    ]
    assert [r["left"] for r in last(told, "robots")["robots"]] == [0, 0]
    assert [r["lessons"] for r in last(told, "robots")["robots"]] == [2, 2]
    assert said(told)[-2:] == [f"Lesson {n} of 2, as Robot 1 had it." for n in (1, 2)]
    done(robot, "repeat", robot=first)
    assert "had all those lessons" in said(told)[-1]


@pytest.mark.slow
def test_lessons_that_were_stopped_go_on_where_they_were(robot, told):
    first = last(told, "robots")["taught"]
    for name in ("UR ↓", "UR ←"):
        shown(robot, name)
        done(robot, "learn")
    begun(robot)
    learned = len([m for m in told if m["type"] == "learned"])
    robot._stop_asked = lambda: len([m for m in told if m["type"] == "learned"]) > learned
    done(robot, "repeat", robot=first)
    assert "Stopped" in said(told)[-1]
    assert [len(e["errors"]) > 0 for e in last(told, "session")["notebook"]] == [True, False]
    robot._stop_asked = lambda: False
    done(robot, "repeat", robot=first)
    assert [e["motion"] for e in last(told, "session")["notebook"]] == ["UR ↓", "UR ←"]


@pytest.mark.slow
def test_all_are_compared_at_the_same_motions(robot, told):
    done(robot, "compare")
    assert "nothing to compare yet" in said(told)[-1]
    shown(robot, "UR ↓")
    begun(robot, grows="beginning")
    shown(robot, "UR ←")
    assert {r["tries"] for r in last(told, "robots")["robots"]} == {None}
    done(robot, "compare")
    assert [m["done"] for m in told if m["type"] == "progress"] == [1, 2, 3, 4]
    for one in last(told, "robots")["robots"]:
        errors = [each["error_cm"] for each in one["tries"]]
        assert [each["motion"] for each in one["tries"]] == ["UR ↓", "UR ←"]
        assert one["error_cm"] == pytest.approx(sum(errors) / 2, abs=0.01) and one["of"] == 2
        assert one["can"] == sum(each["good"] for each in one["tries"])
    done(robot, "learn")
    assert [r["can"] is None for r in last(told, "robots")["robots"]] == [False, True]


@pytest.mark.slow
def test_a_session_that_was_sent_takes_the_place_of_this_one(robot, told, tmp_path):
    home = tmp_path / "session"
    begun(robot, name="Second")
    shown(robot, "UR ↓")
    (tmp_path / "file").write_bytes(pack(home))
    shown(robot, "UR ←")
    done(robot, "open", file=NUMBER)
    assert "not here any more" in said(told)[-1]
    unpack(tmp_path / "file", home / f"{OPENED}{NUMBER}")
    told.clear()
    done(robot, "open", file=NUMBER)
    assert [m["type"] for m in told if m["type"] in ("scene", "begun")] == ["scene", "begun"]
    assert [e["motion"] for e in last(told, "session")["notebook"]] == ["UR ↓"]
    assert "put away" in said(told)[-1] and last(told, "session")["busy"] == ""
    earlier = SessionFolder(home / "earlier-01" / "robot-2").read()
    assert [e.motion for e in earlier.notebook.entries] == ["UR ↓", "UR ←"]
    folder = SessionFolder(home)
    again = Robot(folder, open_session(folder, ""), told.append, lambda: False)
    assert [e.motion for e in again.teaching.notebook.entries] == ["UR ↓"], "and is found again"


def test_a_session_that_cannot_be_read_changes_nothing(robot, told, tmp_path):
    home = tmp_path / "session"
    begun(robot)
    (home / f"{OPENED}{NUMBER}").mkdir()
    (home / f"{OPENED}{NUMBER}" / "session.json").write_text("{}")
    done(robot, "open", file=NUMBER)
    assert said(told)[-1] == (
        "This session cannot be opened: session.json was not written by motionese"
    )
    assert len(last(told, "robots")["robots"]) == 2 and not list(home.glob("earlier-*"))
