"""Five robots learn on one page, one after the other, and what becomes of memory and session.

A script in a person's place shows motions, lets the robot imitate, practise, grow, draw the map and
forget, for as long as it is told, through the connection that the page uses. Half-way through every
robot its process is killed (kill -9), and at the end the server itself: the notebook must be what
it was. Memory is what processes hold in RAM; how fast it grows is the slope of a straight line
through all values from a robot's second half, by lessons.

    python benchmarks/page_endurance.py --minutes 30
"""

import argparse
import json
import sys
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from itertools import cycle
from pathlib import Path
from time import monotonic
from typing import Any

import numpy as np
from psutil import Process
from rich.console import Console
from rich.table import Table

from motionese.teaching.school import MOST

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
try:
    from drawn import strokes
    from page.serving import Served, served
    from websockets.sync.client import ClientConnection, connect
except ImportError as error:
    sys.exit(f"this benchmark needs {error.name}: pip install -e '.[dev]'")

ROBOTS = 5
PRIMITIVES = ("UR ↓", "LR ↑", "UR ←", "UL ↓", "LL ↑")
PAIRS = ("UR ↓↑", "LR ↑←", "UR ←↓", "UL ↓↑", "LL ↑↓")
LONG = ("imitate", "learn", "grow", "begin")
"""What the robot tells that it is busy with."""
BEFORE_GROWTH = 6
"""Lessons before a robot grows."""
PATIENCE_S = 300.0
FLAT_MB = 1.0
"""Memory that grows by less with every lesson counts as flat."""

Message = dict[str, Any]


class Visitor:
    """A page without a browser."""

    def __init__(self, socket: ClientConnection) -> None:
        """Wait until the robot is awake."""
        self.socket = socket
        self.session: Message = {}
        self.awake = False
        self.say({"type": "hello", "take": True})
        self.until(lambda message: self.awake and bool(self.session))

    def say(self, message: Message) -> None:
        """Send a message."""
        self.socket.send(json.dumps(message))

    def until(self, wanted: Callable[[Message], bool]) -> Message:
        """Wait for a message."""
        end = monotonic() + PATIENCE_S
        while True:
            message: Message = json.loads(self.socket.recv(timeout=end - monotonic()))
            if message["type"] == "session":
                self.session = message
            if message["type"] == "worker":
                self.awake = message["state"] == "ready"
            if wanted(message):
                return message

    def does(self, kind: str, **more: Any) -> None:
        """Ask for something, and wait until it is over, and has begun where it takes a while."""
        self.say({"type": kind, **more})
        if kind in LONG:
            self.until(lambda m: m["type"] == "session" and m["busy"])
        self.until(lambda m: m["type"] == "session" and not m["busy"])

    def shows(self, motion: str, seed: int) -> None:
        """Draw a motion, and wait for the verdict."""
        for message in strokes(motion, seed=seed):
            self.say(message)
        self.until(lambda message: message["type"] == "verdict")
        self.until(lambda message: message["type"] == "session")

    @property
    def notebook(self) -> list[Message]:
        """What the session holds."""
        return list(self.session["notebook"])


@contextmanager
def visit(server: Served) -> Iterator[Visitor]:
    """Come to a server as a page does."""
    origin = server.awake().address.rstrip("/")
    live = f"{origin.replace('http', 'ws', 1)}/live"
    with connect(live, origin=origin, max_size=None) as socket:
        yield Visitor(socket)


@dataclass
class Life:
    """What was measured of one robot: lessons so far, RAM of its process and of the server [MB]."""

    rows: list[tuple[int, float, float]] = field(default_factory=list)
    intact: bool = True

    @property
    def lessons(self) -> int:
        """How many it had."""
        return self.rows[-1][0] if self.rows else 0

    def slope(self, column: int) -> float:
        """Return by how much memory grew with a lesson in the second half [MB]."""
        values = np.array(self.rows)
        late = values[values[:, 0] >= values[-1, 0] / 2]
        if len(set(late[:, 0])) < 2:
            return float("nan")
        return float(np.polyfit(late[:, 0], late[:, column], 1)[0])


def lesson(visitor: Visitor, motion: str, number: int) -> None:
    """Show a motion, let it be tried and practised; now and then do all else that can be done."""
    visitor.shows(motion, number)
    visitor.does("imitate")
    visitor.does("learn")
    visitor.does("replay", entry=visitor.notebook[0]["entry"])
    if visitor.session["can_grow"] and number >= BEFORE_GROWTH:
        visitor.does("grow")
    if number % 3 == 0:
        visitor.say({"type": "map"})
        visitor.until(lambda message: message["type"] == "map")
        visitor.say({"type": "hover", "slow": [0.5, -1.0], "primitive": "UR ↓"})
    if number % 4 == 3:
        visitor.does("forget", entry=visitor.notebook[-1]["entry"])


def live(server: Served, visitor: Visitor, seconds: float) -> Iterator[Life]:
    """Let a robot learn for so long; killed once, half-way. Yields after every lesson."""
    life, end, killed = Life(), monotonic() + seconds, False
    for number, motion in enumerate(cycle(PRIMITIVES + PAIRS)):
        if monotonic() > end:
            return
        if not killed and monotonic() > end - seconds / 2:
            killed, before = True, visitor.notebook
            visitor.awake = False
            server.worker().kill()
            visitor.until(lambda message: visitor.awake)
            life.intact = visitor.notebook == before
            life.rows.clear()  # a new process begins with less
        lesson(visitor, motion, number)
        life.rows.append((number + 1, held(server.worker()), held(Process(server.process.pid))))
        yield life


def held(process: Process) -> float:
    """Return what a process holds in RAM [MB]."""
    return float(process.memory_info().rss) / 1e6


def main() -> None:
    """Let five robots learn, kill, print."""
    arguments = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    arguments.add_argument("--minutes", type=float, default=30.0, help="in all (default 30)")
    seconds = 60 * arguments.parse_args().minutes / ROBOTS
    console, lives = Console(markup=False, width=100), list[Life]()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with served(folder, "babbling") as server, visit(server) as visitor:
            for number in range(ROBOTS):
                if number:
                    away = visitor.session["id"] if number >= MOST else ""
                    visitor.does("begin", **{"with": "babbling"}, away=away)
                lives.append(Life())
                for life in live(server, visitor, seconds):
                    lives[-1] = life
                    lessons, robot, host = life.rows[-1]
                    console.print(
                        f"robot {number + 1}, lesson {lessons}: {robot:.0f} and {host:.0f} MB"
                    )
            before = visitor.notebook
            server.process.kill()
            server.process.wait()
        with served(folder, "babbling") as server, visit(server) as visitor:
            whole = visitor.notebook == before
    console.print(table_of(lives))
    console.print(f"after kill -9 of the server the notebook is {'whole' if whole else 'damaged'}")


def table_of(lives: list[Life]) -> Table:
    table = Table(title=f"{len(lives)} robots; RAM [MB], flat below {FLAT_MB:g} a lesson")
    for heading in ("robot", "lessons", "its process", "a lesson", "server", "a lesson", "killed"):
        table.add_column(heading, justify="right")
    for number, life in enumerate(lives, 1):
        if not life.rows:
            table.add_row(f"{number}", "0", *["–"] * 5)
            continue
        (_, robot, host), grew, host_grew = life.rows[-1], life.slope(1), life.slope(2)
        cells = [f"{robot:.0f}", f"{grew:+.1f}", f"{host:.0f}", f"{host_grew:+.1f}"]
        table.add_row(f"{number}", f"{life.lessons}", *cells, "whole" if life.intact else "damaged")
    return table


if __name__ == "__main__":
    main()
