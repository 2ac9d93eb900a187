"""The page on which a person teaches the robot, in a headless Chromium that draws in software.

A robot goes through a short experiment first. Then a simulated hand draws its motions on the page,
with the tempo and the tremor of a hand, as in the tests: from lifting the pen to what was seen,
and to the verdict; understanding while the hand moves; samples of the pointer that reach the robot.
At last the command is started again and again: how long until the page can be used, with everything
compiled before; what is drawn on it before the robot is awake is understood when it is. Chromium
shares the processor with the robot here, and who knows what else; so beside what a person waits,
the table tells for how long the robot has computed.

    python benchmarks/teaching.py
"""

import os
import sys
import tempfile
from pathlib import Path
from time import monotonic, sleep

import numpy as np
from psutil import Process
from rich.console import Console
from rich.table import Table

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))
try:
    from page.person import Person
    from page.serving import CHROMIUM, FLAGS, served, train_robot
    from playwright.sync_api import Browser, sync_playwright
except ImportError as error:
    sys.exit(f"this benchmark needs {error.name}: pip install -e '.[dev]'")

MOTIONS = ("UR ↓", "LR ↑", "UR ←", "UL ↓", "LL ↑", "UR ↓↑", "LR ↑←", "UR ←↓", "UL ↓↑")
STROKE_S, STARTS = 1.2, 5
VERDICT_S, UNDERSTOOD_HZ, USABLE_S, ARRIVED = 0.5, 8.0, 3.0, 0.95


def at_the_page(browser: Browser, address: str) -> Person:
    window = browser.new_context(viewport={"width": 1280, "height": 800})
    return Person(window.new_page(), address)


def draw_all(person: Person, worker: Process) -> dict[str, list[float]]:
    """Draw every motion; returns seconds to what was seen, to the verdict, and of computing."""
    kinds = ("saw", "verdict", "thought", "understood", "arrived")
    found: dict[str, list[float]] = {kind: [] for kind in kinds}
    for motion in MOTIONS:
        before, sent = person.state(), person.points_sent()
        began = monotonic()
        moves = person.draws(motion, STROKE_S)
        took = monotonic() - began
        understood = person.state()["understandings"] - before["understandings"]
        lifted, busy = monotonic(), computed(worker)
        person.page.mouse.up()
        while person.state()["saw"] == before["saw"]:
            sleep(0.002)
        found["saw"].append(monotonic() - lifted)
        while person.state()["step"] != "judged":
            sleep(0.002)
        found["verdict"].append(monotonic() - lifted)
        found["thought"].append(computed(worker) - busy)
        found["understood"].append(understood / took)
        found["arrived"].append((person.points_sent() - sent - 1) / moves)
        person.until(lambda state: not state["busy"])
    return found


def computed(worker: Process) -> float:
    """Return for how long a process has been computing [s], whoever else did meanwhile."""
    times = worker.cpu_times()
    return float(times.user + times.system)


def seconds_until(browser: Browser, run: Path) -> dict[str, float]:
    """Return how long from the command until the page is shown, can be drawn on, is answered."""
    with tempfile.TemporaryDirectory() as folder:
        began = monotonic()
        with served(Path(folder), run) as server:
            person = at_the_page(browser, server.address)
            person.page.goto(server.address)
            took = {"shown": monotonic() - began}
            for what in ("watching", "ready"):
                while not person.state().get(what):
                    sleep(0.01)
                took[what] = monotonic() - began
                took[f"{what}, computed"] = computed(server.worker())
            person.page.context.close()
    return took


def main() -> None:
    """Train, draw, start again and again, print."""
    if CHROMIUM is None:
        sys.exit("this benchmark needs Chromium: apt install chromium")
    console, load = Console(markup=False), os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as name, sync_playwright() as playwright:
        run = Path(name) / "run"
        train_robot(run)
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=list(FLAGS))
        with served(Path(name), run) as server:
            person = at_the_page(browser, server.address).arrives()
            found = draw_all(person, server.worker())
        starts = [seconds_until(browser, run) for _ in range(STARTS)]
        browser.close()
    table = Table(title=f"{len(MOTIONS)} motions drawn, {STARTS} starts of the command")
    for heading in ("", "median", "worst", "target", ""):
        table.add_column(heading, justify="right" if table.columns else "left")
    for label, values, worst, target, met in (
        ("pen up to what it saw [s]", found["saw"], max, VERDICT_S, False),
        ("pen up to verdict shown [s]", found["verdict"], max, VERDICT_S, False),
        ("  computed by the robot [s]", found["thought"], max, None, False),
        ("understandings a second", found["understood"], min, UNDERSTOOD_HZ, True),
        ("pointer samples that arrive", found["arrived"], min, ARRIVED, True),
        ("command to page shown [s]", [s["shown"] for s in starts], max, None, False),
        ("command to page usable [s]", [s["watching"] for s in starts], max, USABLE_S, False),
        (
            "  computed by the robot [s]",
            [s["watching, computed"] for s in starts],
            max,
            None,
            False,
        ),
        ("command to robot awake [s]", [s["ready"] for s in starts], max, None, False),
        ("  computed by the robot [s]", [s["ready, computed"] for s in starts], max, None, False),
    ):
        middle, bad = float(np.median(values)), float(worst(values))
        row = [label, f"{middle:.2f}", f"{bad:.2f}"]
        if target is not None:
            good = middle >= target if met else middle <= target
            row += [f"{'≥' if met else '≤'} {target:g}", "met" if good else "missed"]
        table.add_row(*row)
    console.print(table)
    console.print(
        f"load average {load:.1f} before, {os.getloadavg()[0]:.1f} after, on {os.cpu_count()} cores"
    )


if __name__ == "__main__":
    main()
