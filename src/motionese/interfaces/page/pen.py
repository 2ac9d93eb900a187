"""The pen: a drawing as it comes, and what the robot understands of it meanwhile."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from motionese.interfaces.page.descriptions import listed
from motionese.interfaces.page.messages import Answer
from motionese.teaching.drawing import Demonstration, Drawing, DrawingError, demonstrated
from motionese.teaching.notebook import Source
from motionese.teaching.reading import arrows_passed, corners_of
from motionese.teaching.recognising import Understood
from motionese.teaching.session import Teaching
from motionese.teaching.verdict import SPREAD_CM
from motionese.teaching.view import View

EVERY_S = 0.1
"""What is understood is told at most so often."""


class Pen:
    """One drawing at a time."""

    def __init__(self, teaching: Teaching, view: View, tell: Callable[[Answer], None]) -> None:
        """Draw in a view, for a robot; `tell` gets what it understands."""
        self._teaching, self._view, self._tell = teaching, view, tell
        self._drawing: Drawing | None = None
        self._source: Source = "drawn"
        self._new, self._told_at = False, 0.0
        self.understood: Understood | None = None

    @property
    def down(self) -> bool:
        """Whether something is being drawn."""
        return self._drawing is not None

    @property
    def source(self) -> Source:
        """Who draws."""
        return self._source

    def set_down(self, source: Source) -> None:
        """Begin a drawing."""
        self._drawing, self._source, self.understood = Drawing(), source, None

    def move(self, points: list[tuple[float, float, float]]) -> None:
        """Draw on."""
        if self._drawing is not None:
            self._drawing.add(points)
            self._new = self._new or bool(points)

    def lift(self) -> None:
        """Leave the drawing as it is; nothing is shown."""
        self._drawing, self._new = None, False

    def wait(self) -> float | None:
        """Return in how many seconds there is something to understand; None while there is not."""
        if self._drawing is None or not self._new:
            return None
        return max(0.0, self._told_at + EVERY_S - time.monotonic())

    def understand(self) -> None:
        """Tell what is understood so far."""
        self._new, self._told_at = False, time.monotonic()
        drawing = self._drawing
        if drawing is None or len(drawing) < 2:
            return
        try:
            demonstration, _ = self._demonstrated(drawing)
        except DrawingError:
            return
        self.tell_understood(demonstration.path, round(1000 * drawing.seconds))

    def tell_understood(self, path: Any, milliseconds: int) -> None:
        """Tell what the robot understands of a path [m, world] so far."""
        teaching = self._teaching
        watched = teaching.watch(path)
        understood = teaching.recogniser.so_far(watched, self.understood)
        if understood is None:
            return
        self.understood = understood
        apart = 100 * float(np.linalg.norm(understood.path - watched.path, axis=1).mean())
        corners = corners_of(teaching.scene.settings.caregiver)
        self._tell(
            {
                "type": "understanding",
                "t_ms": milliseconds,
                "arrows": arrows_passed(understood.path, corners),
                # How well what is understood fits what was seen, by the spread of the verdict.
                "confidence": round(float(np.exp(-((apart / SPREAD_CM) ** 2) / 2)), 4),
                "path": listed(self._view.of_points(understood.path)),
                "next": listed(self._view.of_points(understood.next)),
            }
        )

    def finished(self) -> tuple[Demonstration, str]:
        """End the drawing; return what it shows, and a hint or "".

        Raises:
            DrawingError: It is too short or too long.
        """
        drawing, self._drawing, self._new = self._drawing, None, False
        if drawing is None or len(drawing) < 2:
            raise DrawingError("That was very short: draw from one corner to another.")
        demonstration, strayed = self._demonstrated(drawing)
        if drawing.full:
            return demonstration, "A drawing lasts at most 20 s: I saw its beginning."
        if strayed:
            return demonstration, "Part of it was out of my arm's reach: I saw the nearest way."
        return demonstration, ""

    def _demonstrated(self, drawing: Drawing) -> tuple[Demonstration, bool]:
        scene = self._teaching.scene
        positions, strayed = self._view.positions(drawing.sampled(scene.body.rate_hz))
        return demonstrated(positions, scene.settings.caregiver), bool(strayed.any())
