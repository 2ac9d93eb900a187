"""The robot's process: killed and restarted, refused, and the command that serves it."""

import io
import json
import os
import signal
import time
import urllib.request
import webbrowser
from dataclasses import replace

import numpy as np
import pytest
from drawn import strokes
from pages import page, served
from rich.console import Console

from motionese.errors import SettingError, StorageError
from motionese.imitation import Scene
from motionese.interfaces.page.robot import Robot
from motionese.interfaces.page.server import teach
from motionese.interfaces.page.supervisor import Supervisor
from motionese.interfaces.page.worker import Origin
from motionese.teaching.session import PRACTICE
from motionese.teaching.session_folder import SessionFolder


@pytest.fixture
def session(tmp_path, small_settings):
    folder, scene = SessionFolder(tmp_path / "session"), Scene(small_settings, 0)
    folder.begin("fresh", scene)
    return folder.path


def ready(own):
    return own.hear("worker", where=lambda m: m["state"] == "ready")


@pytest.mark.slow
def test_a_killed_robot_comes_back_with_all_but_the_motion_under_way(session):
    made = served(lambda told: Supervisor(Origin("", session), told), session)
    with made as client, page(client) as own:
        ready(own)
        for message in strokes("UR ↓"):
            own.say(message)
        own.hear("verdict")
        before = own.hear("session")
        *drawing, up = strokes("UR ←")
        for message in drawing[:4]:
            own.say(message)
        killed = client.hub.worker_pid
        os.kill(killed, signal.SIGKILL)
        told = own.hear("worker")
        assert told["state"] == "restarted" and "saved session" in told["sentence"]
        for message in [*drawing[4:], up]:
            own.say(message)
        ready(own)
        assert client.hub.worker_pid != killed
        again = [m for m in own.heard if m["type"] == "session"][-1]
        assert again["notebook"] == before["notebook"] and again["id"] == before["id"]
        assert (again["shown"], again["watched"]) == (before["shown"], before["watched"])
        assert before["chapter"]["name"] == "try" and again["chapter"] == before["chapter"]
        for message in strokes("UR ←"):
            own.say(message)
        assert own.hear("verdict")["shown"] == "UR ←"
    assert len(SessionFolder(session).read().notebook.entries) == 2


def test_learning_is_stopped_without_a_trace(session, draw_with):
    folder, told = SessionFolder(session), []
    robot = Robot(folder, folder.read(), told.append, stop_asked=lambda: True)
    draw_with(robot, "UR ↓")
    before, learner = robot.teaching.notebook, robot.teaching.learner
    robot.take({"type": "learn"})
    while robot.going is not None:
        robot.go_on()
    assert robot.teaching.notebook == before and robot.teaching.learner is learner
    assert "Stopped" in next(m["sentence"] for m in told if m["type"] == "told")
    assert told[-1]["type"] == "session" and told[-1]["busy"] == ""
    robot.take({"type": "imitate"})
    robot.go_on()
    robot.take({"type": "stop"})
    assert robot.going is None, "a performance ends at once"


def test_stop_is_heard_between_the_motions_that_are_measured_after_a_lesson(session, draw_with):
    folder, told, measured = SessionFolder(session), [], []

    def stop_asked():
        tries = sum(m["type"] == "practice" for m in told)
        measured.append(tries > PRACTICE)
        return measured.count(True) > 1

    robot = Robot(folder, folder.read(), told.append, stop_asked)
    learner = robot.teaching.learner
    for motion in ("UR ←", "UL ↓", "LL ↑"):
        values = np.full((14, len(learner.channels)), 0.5)
        learner = learner.experiencing(1, motion, values, np.zeros(learner.network.size))
    robot.teaching.return_to(replace(robot.teaching.standing, learner=learner))
    draw_with(robot, "UR ↓")
    robot.take({"type": "learn"})
    while robot.going is not None:
        robot.go_on()
    assert measured.count(True) == 2, "after the first of three motions"
    assert "Stopped" in next(m["sentence"] for m in told if m["type"] == "told")
    assert robot.teaching.learner is learner and told[-1]["busy"] == ""


def test_growth_of_what_knows_nothing_is_answered_in_plain_words(session):
    folder, told = SessionFolder(session), []
    robot = Robot(folder, folder.read(), told.append, stop_asked=lambda: False)
    robot.take({"type": "grow"})
    while robot.going is not None:
        robot.go_on()
    assert "First show me a motion" in next(m["sentence"] for m in told if m["type"] == "told")
    assert told[-1]["type"] == "session" and told[-1]["phase"] == 1


def test_no_browser_is_opened_before_it_is_known_what_to_teach(tmp_path, monkeypatch):
    opened = []
    monkeypatch.setattr(webbrowser, "open", opened.append)
    quiet = Console(file=io.StringIO())
    with pytest.raises(SettingError, match="no run folder"):
        teach(
            quiet,
            begin="nowhere",
            session=tmp_path / "session",
            host="127.0.0.1",
            port=0,
            token="",
            browser=True,
        )
    assert opened == []


def test_a_full_disk_is_told_and_the_robot_goes_on(session, draw_with, monkeypatch):
    folder, told = SessionFolder(session), []
    robot = Robot(folder, folder.read(), told.append, stop_asked=lambda: False)

    def full(teaching):
        raise StorageError("no space left")

    monkeypatch.setattr(folder, "save", full)
    draw_with(robot, "UR ↓")
    assert told[-1] == {"type": "told", "kind": "error", "sentence": "no space left"}


def test_a_robot_that_cannot_begin_says_why_and_is_not_tried_again(tmp_path):
    (tmp_path / "mine.txt").write_text("not a session")
    with served(lambda told: Supervisor(Origin("", tmp_path), told), tmp_path) as client:
        deadline = time.monotonic() + 30
        while not client.refused and time.monotonic() < deadline:
            time.sleep(0.05)
        assert len(client.refused) == 1 and "no session" in client.refused[0]
        with page(client) as own:
            assert own.hear("worker")["state"] == "failed"


def test_the_command_serves_until_it_is_stopped(begin, session):
    process = begin("teach", "--no-browser", "--session", str(session))
    said = process.stdout.readline()
    address = next(word for word in said.split() if word.startswith("http://127.0.0.1:"))
    with urllib.request.urlopen(address) as answer:
        assert b"<html" in answer.read()
    other = begin("teach", "--no-browser", "--session", str(session))
    assert other.wait(20) == 2 and "another process teaches" in other.stderr.read()
    with urllib.request.urlopen(f"{address}health") as answer:
        assert json.load(answer)["worker"] in ("starting", "ready")
    process.send_signal(signal.SIGINT)
    assert process.wait(10) == 130 and "session is kept" in process.stderr.read()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--host", "0.0.0.0"], "--token"),
        (["--host", "no such host"], "--host"),
        (["--begin", "nowhere"], "no run folder"),
    ],
)
def test_what_cannot_be_served_is_told_in_one_line(begin, options, said):
    process = begin("teach", "--no-browser", *options)
    assert process.wait(30) == 2
    errors = process.stderr.read()
    assert said in errors and errors.count("\n") == 1 and errors.startswith("motionese: ")
