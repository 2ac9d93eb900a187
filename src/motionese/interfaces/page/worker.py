"""The process that holds the robot and its learning: commands in, messages out."""

import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from multiprocessing.connection import Connection
from pathlib import Path
from typing import TYPE_CHECKING, Any

from motionese.errors import MotioneseError
from motionese.interfaces.page.messages import worker_message

if TYPE_CHECKING:
    from motionese.interfaces.page.robot import Robot


@dataclass(frozen=True)
class Origin:
    """What a robot begins from, as `open_session` takes it, and its session's folder."""

    begin: str
    session: Path


def work(connection: Connection, origin: Origin) -> None:
    """Serve until the server goes away; the worker process begins here."""
    waiting: deque[dict[str, Any]] = deque()

    def stop_asked() -> bool:
        """Whether the person has asked to stop; what else was said meanwhile waits."""
        stop = False
        while connection.poll():
            message = heard()
            stop = stop or message["type"] == "stop"
            if message["type"] != "stop":
                waiting.append(message)
        return stop

    def heard() -> dict[str, Any]:
        """Return the next thing that is said; `EOFError` where nothing more will be."""
        message: dict[str, Any] = connection.recv()
        if message["type"] == "end":
            raise EOFError
        return message

    try:
        robot = _awake(connection, origin, stop_asked)
        if robot is not None:
            _serve(connection, robot, waiting, heard)
    except (EOFError, BrokenPipeError, ConnectionResetError, KeyboardInterrupt):
        pass  # the server has gone, and with it the one who would hear of it


def _awake(
    connection: Connection, origin: Origin, stop_asked: Callable[[], bool]
) -> "Robot | None":
    """Return the robot, everything compiled; None where it cannot begin."""
    # What takes time to import is imported by this process alone, so that the page comes at once.
    from motionese.interfaces.page.robot import Robot, open_session  # noqa: PLC0415
    from motionese.teaching.session_folder import SessionFolder  # noqa: PLC0415

    folder = SessionFolder(origin.session)
    goes_on = folder.exists
    try:
        teaching = open_session(folder, origin.begin)
    except MotioneseError as error:
        connection.send({"type": "refused", "sentence": str(error)})
        return None
    robot = Robot(folder, teaching, connection.send, stop_asked)
    robot.introduce()
    teaching.warm_up()
    if teaching.notebook.entries:
        # What is imitated next is what is shown, also after the process was killed.
        teaching.look_back(teaching.notebook.entries[-1].number)
        robot.tell_session()
    sentence = "The session goes on where it was." if goes_on else ""
    connection.send(worker_message("ready", sentence))
    return robot


def _serve(
    connection: Connection,
    robot: "Robot",
    waiting: deque[dict[str, Any]],
    heard: Callable[[], dict[str, Any]],
) -> None:
    due = 0.0
    while True:
        waits = [robot.pen.wait(), None if robot.going is None else due - time.monotonic()]
        known = [max(0.0, wait) for wait in waits if wait is not None]
        if waiting or connection.poll(min(known, default=None)):
            robot.take(waiting.popleft() if waiting else heard())
            continue  # all that was said comes before what follows from it
        if robot.pen.wait() == 0.0:
            robot.pen.understand()
        if robot.going is not None and due <= time.monotonic():
            pause = robot.go_on()
            due = time.monotonic() + (pause or 0.0)
