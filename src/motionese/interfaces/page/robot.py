"""The robot in its process: what it does when it is told to, and what it tells."""

import time
from collections.abc import Callable, Iterator
from typing import Any

from motionese.body import Geometry
from motionese.caregiver import PUSHING_BUTTONS
from motionese.errors import MotioneseError, TaskError
from motionese.experiment.keys import generator_for
from motionese.interfaces.page import descriptions
from motionese.interfaces.page.descriptions import frames_message
from motionese.interfaces.page.messages import Answer
from motionese.interfaces.page.pen import Pen
from motionese.learning import Progress
from motionese.teaching.drawing import Demonstration, DrawingError, most_rows
from motionese.teaching.frames import film
from motionese.teaching.notebook import Source
from motionese.teaching.saving import SessionFolder
from motionese.teaching.session import Imitation, Teaching
from motionese.teaching.slow_map import SlowMap
from motionese.teaching.view import View

GHOST_S = 0.2
"""While the scripted caregiver shows, what is understood is told this often."""
NOTHING_SHOWN = "Show me a motion first: draw one, or let the caregiver show one."


class StoppedError(Exception):
    """Learning was stopped by the person."""


class Robot:
    """Does one thing after the other; what takes time is a generator that yields waiting times.

    Attributes:
        going: What is under way, or None.
    """

    def __init__(
        self,
        folder: SessionFolder,
        teaching: Teaching,
        tell: Callable[[Answer], None],
        stop_asked: Callable[[], bool],
    ) -> None:
        """Serve a session; `stop_asked` says, while the network learns, whether to stop."""
        self._folder, self._tell, self._stop_asked = folder, tell, stop_asked
        self._view, self._geometry = View(), Geometry()
        self.going: Iterator[float] | None = None
        self._busy = ""
        self._map: SlowMap | None = None
        self._become(teaching)

    def _become(self, teaching: Teaching) -> None:
        self.teaching = teaching
        self.pen = Pen(teaching, self._view, self._tell)
        self._map = None

    def introduce(self) -> None:
        """Tell what the page needs to begin with."""
        scene = self.teaching.scene
        scene.body.reset(scene.postures["UR"], generator_for(scene.seed, "rest"))
        self._tell(descriptions.scene_message(scene, self._view, self._geometry))
        self.tell_session()

    def tell_session(self, busy: str | None = None) -> None:
        """Tell where the session stands."""
        self._busy = self._busy if busy is None else busy
        folder = self._folder
        self._tell(descriptions.session_message(self.teaching, folder.id, folder.began, self._busy))

    def take(self, message: dict[str, Any]) -> None:
        """Do what a message says, or begin to."""
        kind = message["type"]
        if kind == "pen":
            self._draw(message)
        elif kind == "stop":
            self._end()
        elif kind == "left":
            self.pen.lift()
        elif kind == "hover":
            self._hover(message)
        elif self._busy:
            self._hint(f"I am {self._busy}; wait a moment, or stop me.")
        else:
            self.going = self._begun(kind)(message)

    def _begun(self, kind: str) -> Callable[[dict[str, Any]], Iterator[float]]:
        return {
            "demonstrate": self._demonstrate,
            "imitate": self._imitate,
            "learn": self._learn,
            "forget": self._forget,
            "grow": self._grow,
            "map": self._draw_map,
            "begin": self._begin,
        }[kind]

    def go_on(self) -> float | None:
        """Go on with what is under way; return how long to wait before it goes on, or None."""
        if self.going is None:
            return None
        try:
            return next(self.going)
        except StopIteration:
            self._end()
        except StoppedError:
            self._hint("Stopped: I am as I was before.")
            self._end()
        except MotioneseError as error:
            self._tell(descriptions.sentence_message("error", str(error)))
            self._end()
        return None

    def _end(self) -> None:
        self.going = None
        if self._busy:
            self.tell_session("")

    def _hint(self, sentence: str) -> None:
        self._tell(descriptions.sentence_message("hint", sentence))

    def _draw(self, message: dict[str, Any]) -> None:
        if message["phase"] == "down":
            if self._busy:
                self._hint(f"I am {self._busy}; wait a moment, or stop me.")
                return
            self.pen.set_down(message["source"])
        self.pen.move(message["points"])
        if message["phase"] == "up" and self.pen.down:
            hint = ""
            try:
                demonstration, hint = self.pen.finished()
                self._show(demonstration, self.pen.source, message["received"])
            except DrawingError as error:
                hint = str(error)
            except MotioneseError as error:
                self._tell(descriptions.sentence_message("error", str(error)))
            if hint:
                self._hint(hint)

    def _show(self, demonstration: Demonstration, source: Source, ended: float) -> None:
        shown = self.teaching.show(demonstration, source, self.pen.understood)
        self._tell(descriptions.verdict_message(shown, self._view, time.monotonic() - ended))
        self._save()

    def _save(self) -> None:
        self._folder.save(self.teaching)
        self.tell_session()

    def _demonstrate(self, message: dict[str, Any]) -> Iterator[float]:
        scene = self.teaching.scene
        try:
            motion = PUSHING_BUTTONS.motion(message["motion"])
            if 14 * len(motion.primitives) > most_rows(scene.settings.caregiver):
                raise TaskError(f"{motion.name} is too long to be shown")
        except TaskError as error:
            self._tell(descriptions.sentence_message("refusal", str(error)))
            return
        self.tell_session("demonstrating")
        number = self.teaching.notebook.next
        path = scene.caregiver.demonstrate(motion, generator_for(scene.seed, "shown", number))
        step = 1000 / scene.body.rate_hz
        self._tell(descriptions.shown_message(motion, self._view.of_points(path), step))
        self.pen.lift()
        self.pen.understood = None
        rows = round(GHOST_S * scene.body.rate_hz)
        for row in range(rows, len(path), rows):
            yield GHOST_S
            self.pen.tell_understood(path[:row], round(step * row))
        yield GHOST_S
        self._show(Demonstration(path, path), "scripted", time.monotonic())

    def _imitate(self, message: dict[str, Any]) -> Iterator[float]:
        if self.teaching.shown is None:
            self._hint(NOTHING_SHOWN)
            return
        self.tell_session("performing")
        yield from self._perform(self.teaching.imitate())

    def _perform(self, imitation: Imitation) -> Iterator[float]:
        teaching = self.teaching
        shown = teaching.shown
        assert shown is not None, "only what was shown is imitated"
        self._save()
        scene, network = teaching.scene, teaching.learner.network
        steps = most_rows(scene.settings.caregiver)
        performance = imitation.performance
        played = film(scene, self._geometry, network, imitation.state, performance, steps)
        yield from frames_message(played, self._tell)
        path = self._view.of_points(performance.path)
        self._tell(descriptions.performed_message(shown.entry, imitation, path))

    def _learn(self, message: dict[str, Any]) -> Iterator[float]:
        shown = self.teaching.shown
        if shown is None:
            self._hint(NOTHING_SHOWN)
            return
        self.tell_session("learning")
        yield 0.0
        change = self._unless_stopped(lambda: self.teaching.learn(self._progress("learning")))
        self._map = None
        self._save()
        curve = self.teaching.notebook.curve
        self._tell(descriptions.learned_message(shown.entry.number, change, curve))

    def _grow(self, message: dict[str, Any]) -> Iterator[float]:
        if not self.teaching.can_grow:
            self._hint("All levels are open already.")
            return
        self.tell_session("growing")
        yield 0.0
        changes = self._unless_stopped(lambda: self.teaching.grow(self._progress("growing")))
        self._map = None
        self._save()
        self._tell(descriptions.grown_message(changes, self.teaching.learner.network))

    def _unless_stopped(self, change: Callable[[], Any]) -> Any:
        """Do what changes the session; a person who stops it finds all as it was before."""
        teaching = self.teaching
        before = (teaching.learner, teaching.notebook, teaching.shown)
        try:
            return change()
        except (StoppedError, MotioneseError):
            teaching.return_to(*before)
            raise

    def _progress(self, what: str) -> Callable[[int, int, Progress], None]:
        def told(done: int, of: int, now: Progress) -> None:
            self._tell(descriptions.progress_message(what, done, of, now))
            if self._stop_asked():
                raise StoppedError

        return told

    def _forget(self, message: dict[str, Any]) -> Iterator[float]:
        said = self.teaching.forget(message["entry"], self._folder.learner)
        self._map = None
        self._save()
        self._hint(said or "This entry is not in the notebook any more.")
        yield 0.0

    def _draw_map(self, message: dict[str, Any]) -> Iterator[float]:
        if not SlowMap.possible(self.teaching):
            self._hint("There is no slow level yet: let the network grow first.")
            return
        self.tell_session("drawing the map")
        yield 0.0
        self._map = self._map or SlowMap(self.teaching)
        self._tell(descriptions.map_message(self._map))

    def _begin(self, message: dict[str, Any]) -> Iterator[float]:
        self.tell_session("beginning anew")
        yield 0.0
        self._become(self._folder.begun_anew(message["with"], self.teaching))
        self._tell({"type": "begun"})
        self._hint("A new robot. The session before is kept in the session's folder.")

    def _hover(self, message: dict[str, Any]) -> None:
        if self._map is None or self._busy:
            return
        path = self._map.motion(message["primitive"], message["cs"])
        if path is not None:
            self._tell({"type": "hovered", "path": descriptions.listed(self._view.of_points(path))})
