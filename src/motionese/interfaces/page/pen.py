"""The pen: a drawing as it comes, and what the robot understands of it meanwhile."""

import time
from contextlib import suppress

from jaxtyping import Float
from numpy import ndarray

from motionese.body import Geometry
from motionese.caregiver import Demonstration
from motionese.interfaces.page.descriptions import frames_message, understanding_message
from motionese.interfaces.page.messages import Tell
from motionese.teaching.drawing import Drawing, DrawingError, at_tempo
from motionese.teaching.following import Following
from motionese.teaching.frames import film
from motionese.teaching.notebook import Source
from motionese.teaching.online_recogniser import OnlineRecogniser, Understanding
from motionese.teaching.recogniser import start_of
from motionese.teaching.session import Teaching
from motionese.teaching.view import View

EVERY_S = 0.04
"""What is understood is told at most so often."""


class Pen:
    """One drawing at a time."""

    def __init__(self, teaching: Teaching, view: View, geometry: Geometry, tell: Tell) -> None:
        """Draw in a view, for a robot; `tell` gets what it understands, and the arm's frames."""
        self._teaching, self._view, self._geometry, self._tell = teaching, view, geometry, tell
        self._drawing: Drawing | None = None
        self.source: Source = "drawn"
        self._new, self._told_at = False, 0.0
        self._online: OnlineRecogniser | None = None
        self._follows, self._frames = False, 0
        self._following: Following | None = None

    @property
    def down(self) -> bool:
        """Whether something is being drawn."""
        return self._drawing is not None

    def set_down(self, source: Source, follow: bool = False) -> None:
        """Begin a drawing; the robot's arm may follow it."""
        self._drawing, self.source = Drawing(), source
        self.begin()
        self._follows = follow

    def begin(self) -> None:
        """Forget what was understood of the motion before."""
        self._online = self._teaching.recogniser.online()
        self._follows, self._following, self._frames = False, None, 0

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
        if self._online is None:
            return
        teaching = self._teaching
        understood = self._online.observe(teaching.watch(Demonstration(path, (0,))))
        if not understood:
            return
        start = start_of(path, teaching.scene.task).start
        seen = teaching.seen(path, whole=False)
        self._tell(understanding_message(understood[-1], seen, self._view, milliseconds))
        if self._follows:
            self._follow(understood, start)

    def _follow(self, understood: list[Understanding], start: str) -> None:
        """Let the arm do what was understood."""
        if self._following is None:
            self._following = Following(self._teaching.scene, start, understood[0])
        for each in understood:
            self._following.follow(each)
        self._show_arm(self._following, last=False)

    def _show_arm(self, following: Following, last: bool) -> None:
        """Tell the frames of the arm's motion that are new."""
        teaching = self._teaching
        network, rate_hz = teaching.learner.network, teaching.scene.body.rate_hz
        levels = dict(zip(network.names, network.sizes, strict=True))
        made = film(self._geometry, levels, following.performance, rate_hz)
        begin, self._frames = self._frames, len(made)
        if begin < len(made):
            self._tell(frames_message(made, begin, len(made), last))

    def finished(self) -> tuple[Float[ndarray, "T 3"], Float[ndarray, "R 3"], str]:
        """End the drawing; return the hand's path, the same in its own time, and a hint or "".

        Raises:
            DrawingError: It is too short or too long.
        """
        drawing, self._drawing, self._new = self._drawing, None, False
        if self._following is not None:
            self._following.catch_up()
            self._show_arm(self._following, last=True)
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
