"""The pen: a drawing as it comes, and what the robot understands of it meanwhile."""

import time
from contextlib import suppress

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import Demonstration, sequence_in
from motionese.imitation import path_error_cm
from motionese.interfaces.page.descriptions import listed
from motionese.interfaces.page.messages import Tell
from motionese.teaching.drawing import Drawing, DrawingError, at_tempo
from motionese.teaching.notebook import Source
from motionese.teaching.recogniser import Interpretation, start_of
from motionese.teaching.session import Teaching
from motionese.teaching.verdict import SPREAD_CM
from motionese.teaching.view import View

EVERY_S = 0.1
"""What is understood is told at most so often."""


class Pen:
    """One drawing at a time."""

    def __init__(self, teaching: Teaching, view: View, tell: Tell) -> None:
        """Draw in a view, for a robot; `tell` gets what it understands."""
        self._teaching, self._view, self._tell = teaching, view, tell
        self._drawing: Drawing | None = None
        self.source: Source = "drawn"
        self._new, self._told_at = False, 0.0
        self._name = ""
        self.understood: Interpretation | None = None

    @property
    def down(self) -> bool:
        """Whether something is being drawn."""
        return self._drawing is not None

    def set_down(self, source: Source) -> None:
        """Begin a drawing."""
        self._drawing, self.source = Drawing(), source
        self.begin()

    def begin(self) -> None:
        """Forget what was understood of the motion before."""
        self.understood, self._name = None, ""

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
        with suppress(DrawingError):
            self.tell_understood(self._shown(drawing)[0], round(1000 * drawing.seconds))

    def tell_understood(self, path: Float[ndarray, "T 3"], milliseconds: int) -> None:
        """Tell what the robot understands of a path [m, world] so far."""
        teaching = self._teaching
        watched = teaching.watch(Demonstration(path, (0,)))
        understood = teaching.recogniser.so_far(watched, self.understood)
        if understood is None:
            return
        self.understood = understood
        apart = path_error_cm(understood.path, watched.path)
        # In the middle of a primitive a path is no sequence: what was completed before stands.
        task = teaching.scene.task
        sequence = sequence_in(understood.path, task)
        self._name = sequence.name if sequence else self._name or start_of(path, task).start
        self._tell(
            {
                "type": "understanding",
                "t_ms": milliseconds,
                "arrows": self._name,
                # How well what is understood fits what was seen, by the spread of the verdict.
                "confidence": round(float(np.exp(-((apart / SPREAD_CM) ** 2) / 2)), 4),
                "path": listed(self._view.of_points(understood.path)),
                "next": listed(self._view.of_points(understood.next)),
            }
        )

    def finished(self) -> tuple[Float[ndarray, "T 3"], Float[ndarray, "R 3"], str]:
        """End the drawing; return the hand's path, the same in its own time, and a hint or "".

        Raises:
            DrawingError: It is too short or too long.
        """
        drawing, self._drawing, self._new = self._drawing, None, False
        if drawing is None or len(drawing) < 2:
            raise DrawingError("That was very short: draw from one place to another.")
        path, drawn, strayed = self._shown(drawing)
        if drawing.full:
            return path, drawn, "A drawing lasts at most 20 s: I saw its beginning."
        if strayed:
            return path, drawn, "Part of it was out of my arm's reach: I saw the nearest way."
        return path, drawn, ""

    def _shown(self, drawing: Drawing) -> tuple[Float[ndarray, "T 3"], Float[ndarray, "R 3"], bool]:
        scene = self._teaching.scene
        drawn, strayed = self._view.positions(drawing.sampled(scene.body.rate_hz))
        path = at_tempo(drawn, scene.task, scene.settings.caregiver)
        return path, drawn, bool(strayed.any())
