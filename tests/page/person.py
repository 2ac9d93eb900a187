"""A person at the page of `motionese teach`: draws, presses buttons and keys, looks."""

import json
import math
import time
from collections.abc import Callable, Sequence
from typing import Any

import cv2
import numpy as np
from playwright.sync_api import Page, WebSocket

from motionese.task import PUSHING_BUTTONS

POINTER_HZ = 70
STROKE_S, REST_S = 0.8, 0.1
TREMOR_PX = 1.5
PATIENCE_S = 60.0
NAMED = {"button", "link", "combobox", "application", "image", "img", "progressbar", "meter"}


class Person:
    """One page, and the person before it."""

    def __init__(self, page: Page, address: str) -> None:
        self.page, self.address = page, address
        self.requests: list[str] = []
        self.complaints: list[str] = []
        self.sent: list[dict[str, Any]] = []
        page.on("request", lambda request: self.requests.append(request.url))
        page.on("pageerror", lambda error: self.complaints.append(str(error)))
        page.on(
            "console",
            lambda said: said.type == "error" and self.complaints.append(said.text),
        )
        page.on("websocket", self._listen)

    def _listen(self, socket: WebSocket) -> None:
        self.requests.append(socket.url)
        socket.on("framesent", lambda payload: self.sent.append(json.loads(payload)))

    def arrives(self) -> "Person":
        """Open the page, and wait until the robot is awake and can be seen."""
        self.page.goto(self.address)
        self.until(lambda state: state["ready"] and state["drawn3d"] and not state["busy"])
        return self

    def state(self) -> dict[str, Any]:
        return self.page.evaluate("window.teach ? window.teach.state() : {ready: false}")

    def until(self, wanted: Callable[[dict[str, Any]], Any], patience: float = PATIENCE_S) -> dict:
        """Wait for a state of the page; its strict policy forbids Playwright's own waiting."""
        end = time.monotonic() + patience
        while not wanted(state := self.state()):
            assert time.monotonic() < end, f"waited {patience:g} s in vain: {self.guide()}, {state}"
            time.sleep(0.03)
        return state

    def guide(self) -> str:
        return self.page.inner_text("#guide")

    def place(self, name: str) -> list[float]:
        """Where a place of the task lies in the view."""
        return list(self.page.evaluate(f"window.teach.place('{name}')"))

    def at(self, place: str) -> tuple[float, float]:
        """Where a place of the task lies in the window [px]."""
        x, y = self.page.evaluate(f"window.teach.pixel(window.teach.place('{place}'))")
        return x, y

    def draw(self, motion: str, stroke_s: float = STROKE_S) -> tuple[int, float]:
        """Draw a motion; returns how many times the pointer was moved, in how many seconds."""
        moves, began = self.draws(motion, stroke_s), time.monotonic()
        self.page.mouse.up()
        return moves, time.monotonic() - began

    def draw_through(self, places: list[str], rest_s: float = REST_S) -> None:
        """Draw from place to place, and rest in each."""
        self.page.evaluate("scrollTo(0, 0)")
        self._draws(places, STROKE_S, rest_s)
        self.page.mouse.up()

    def draws(self, motion: str, stroke_s: float = STROKE_S) -> int:
        """Draw a motion with a minimum-jerk hand that trembles a little, and keep the pen down."""
        return self._draws(PUSHING_BUTTONS.sequence(motion).places, stroke_s)

    def _draws(self, passed: Sequence[str], stroke_s: float, rest_s: float = REST_S) -> int:
        places = [np.array(self.at(place)) for place in passed]
        self.page.mouse.move(*places[0])
        self.page.mouse.down()
        moves, began = 0, time.monotonic()
        each = stroke_s + rest_s
        while (now := time.monotonic() - began) < each * (len(places) - 1):
            stroke, within = divmod(now, each)
            share = min(within / stroke_s, 1.0)
            share = share**3 * (10 - 15 * share + 6 * share**2)
            start, end = places[int(stroke) : int(stroke) + 2]
            tremor = TREMOR_PX * np.array([math.sin(31 * now), math.cos(43 * now)])
            self.page.mouse.move(*(start + share * (end - start) + tremor))
            moves += 1
            time.sleep(max(0.0, began + moves / POINTER_HZ - time.monotonic()))
        self.page.mouse.move(*places[-1])
        return moves + 1

    def shows(self, motion: str) -> dict[str, Any]:
        """Draw a motion and wait for the verdict."""
        self.until(lambda state: not state["busy"])
        self.page.evaluate("scrollTo(0, 0)")
        shown = self.state()["notebook"]
        self.draw(motion)
        return self.until(lambda s: s["step"] == "judged" and s["notebook"] > shown)["verdict"]

    def presses(self, button: str) -> None:
        self.page.get_by_test_id(button).click()

    def goes_to(self, element_id: str) -> None:
        """Press Tab until an element has the focus; every line of the notebook has two stops."""
        for _ in range(60 + 2 * self.state()["notebook"]):
            if self.page.evaluate("document.activeElement.id") == element_id:
                return
            self.page.keyboard.press("Tab")
        raise AssertionError(f"the keyboard does not reach {element_id}")

    def names(self) -> list[tuple[str, str]]:
        """Role and name of everything that can be operated or is a picture, as it is read out."""
        session = self.page.context.new_cdp_session(self.page)
        nodes = session.send("Accessibility.getFullAXTree")["nodes"]
        told = [
            (n.get("role", {}).get("value", ""), n.get("name", {}).get("value", "")) for n in nodes
        ]
        return [(role, name) for role, name in told if role in NAMED]

    def lets_it_imitate(self) -> dict[str, Any]:
        self.presses("imitate")
        return self.until(lambda state: state["step"] == "performed" and not state["busy"])

    def lets_it_learn(self) -> dict[str, Any]:
        before = self.state()["learned"]
        self.presses("learn")
        return self.until(lambda state: state["learned"] != before and not state["busy"])

    def focused(self) -> str:
        return self.page.evaluate("document.activeElement.id")

    def reads(self, test_id: str) -> str:
        return self.page.get_by_test_id(test_id).inner_text()

    def sees(self, test_id: str) -> np.ndarray:
        """The middle of a canvas as it is on the screen, clear of what lies over its rim."""
        picture = cv2.imdecode(
            np.frombuffer(self.page.get_by_test_id(test_id).screenshot(), np.uint8),
            cv2.IMREAD_COLOR,
        )
        height, width = picture.shape[:2]
        rim = height // 6, width // 6
        return picture[rim[0] : -rim[0], rim[1] : -rim[1]].astype(int)

    def tall(self) -> int:
        """How tall the whole page is [px]."""
        return self.page.evaluate("document.documentElement.scrollHeight")

    def points_sent(self) -> int:
        """How many points of drawings have gone to the robot."""
        return sum(len(said["points"]) for said in self.sent if said["type"] == "pen")


def changed(before: np.ndarray, after: np.ndarray) -> float:
    """The share of pixels that differ clearly."""
    return float((np.abs(after - before).max(axis=2) > 24).mean())
