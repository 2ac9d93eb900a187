"""The robot in its process: what it does when it is told to, and what it tells."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

from jaxtyping import Float
from numpy import ndarray

from motionese.body import Geometry
from motionese.errors import MotioneseError, TaskError
from motionese.experiment import read_settings
from motionese.experiment.learned_robot import robot_of
from motionese.imitation import BABBLING, Scene, generator_for
from motionese.interfaces.page import descriptions
from motionese.interfaces.page.messages import Answer, Tell
from motionese.interfaces.page.pen import Pen
from motionese.interfaces.page.robots import Robots
from motionese.learning import Progress
from motionese.teaching.chapters import MAP, end_chapters
from motionese.teaching.drawing import DrawingError, most_rows
from motionese.teaching.frames import Film, film
from motionese.teaching.interactive_map import InteractiveMap
from motionese.teaching.names import rename
from motionese.teaching.notebook import Entry, Source
from motionese.teaching.practice import Report
from motionese.teaching.school import Pupil, School
from motionese.teaching.session import PRACTICE, Teaching
from motionese.teaching.session_contents import settle
from motionese.teaching.session_folder import FRESH, SessionFolder
from motionese.teaching.trial import Trial
from motionese.teaching.view import View

T = TypeVar("T")
GHOST_S = 0.2
"""While the scripted caregiver shows, what is understood is told this often."""
EXPLORED = 3
"""A map is explored when so many of its points were looked at: the first comes by itself."""
NOT_THERE = "This entry is not in the notebook any more."
NOTHING_SHOWN = "Show me a motion first: draw one, or let the caregiver show one."


def open_session(folder: SessionFolder, begin: str) -> Teaching:
    """Return the session of a folder, or one that begins there.

    Args:
        folder: Where it is kept.
        begin: "babbling", "fresh" or the path of a run; empty for what is there, or babbling.

    Raises:
        StorageError: What is in the folder is no session, or it began from something else.
        RunFolderError: No such run.
    """
    settle(folder.path)
    if folder.exists:
        return folder.read(begin)
    if begin in ("", BABBLING, FRESH):
        return folder.begin(begin or BABBLING, Scene(read_settings(), 0))
    robot = robot_of(Path(begin))
    return folder.begin(begin, Scene(robot.settings, robot.seed), robot.learner)


class StoppedError(Exception):
    """Learning was stopped by the person."""


class Robot:
    """Does one thing after the other; `going` is what is under way and yields waiting times [s]."""

    def __init__(
        self, folder: SessionFolder, teaching: Teaching, tell: Tell, stop_asked: Callable[[], bool]
    ) -> None:
        """Serve a session; `stop_asked` says, while the network learns, whether to stop."""
        self._tell, self._stop_asked = tell, stop_asked
        self.going: Iterator[float] | None = None
        self._busy = ""
        self._robots = Robots(self, School(folder, teaching), tell)
        self.become(self._robots.school.taught)

    def become(self, pupil: Pupil) -> None:
        """Be a robot of the session from now on."""
        self._folder, self.teaching = pupil.folder, pupil.teaching
        body, task = self.teaching.scene.body, self.teaching.scene.task
        self._view, self._geometry = View(body, task), Geometry(body.model)
        self.pen = Pen(self.teaching, self._view, self._geometry, self._tell)
        self._network_changed()

    def _network_changed(self) -> None:
        """Forget what was measured of another network; what is to be, is when there is time."""
        self._map: InteractiveMap | None = None
        self._pointed_at: set[tuple[float, ...]] = set()
        self._reflection: Iterator[None] | None = self._reflected()

    def introduce(self) -> None:
        """Tell what the page needs to begin with."""
        scene = self.teaching.scene
        rest = next(iter(scene.postures.values()))
        scene.body.reset(rest, generator_for(scene.seed, "rest"))
        self._tell(descriptions.scene_message(scene, self._view, self._geometry))
        self.tell_session()

    def warm_up(self) -> None:
        """Let everything be compiled that a drawing asks for."""
        self._robots.warm_up()

    def tell_session(self, busy: str | None = None) -> None:
        """Tell where the session stands."""
        self._busy = self._busy if busy is None else busy
        folder = self._folder
        told = descriptions.session_message(
            self.teaching, self._view, folder.id, folder.began, self._busy
        )
        self._tell(told)
        self._robots.tell_all()

    def take(self, message: dict[str, Any]) -> None:
        """Do what a message says, or begin to."""
        kind = message["type"]
        if kind == "stop":
            self._end()
        elif kind == "left":
            self.pen.lift()
        elif kind == "hover":
            self._hover(message)
        elif self._busy and (kind != "pen" or message["phase"] == "down"):
            self._hint(f"I am {self._busy}; wait a moment, or stop me.")
        elif kind == "pen":
            self._draw(message)
        else:
            self.going = {
                "demonstrate": self._demonstrate,
                "imitate": self._imitate,
                "learn": self._learn,
                "forget": self._forget,
                "replay": self._replay,
                "rename": self._rename,
                "grow": self._grow,
                "map": self._draw_map,
                "repeat": self._repeat,
                **self._robots.does,
            }[kind](message)

    def go_on(self) -> float | None:
        """Go on with what is under way; return how long to wait before it goes on, or None."""
        if self.going is None:
            return None
        try:
            return next(self.going)
        except StopIteration:
            pass
        except StoppedError:
            self._hint("Stopped: I am as I was before.")
        except MotioneseError as error:
            self._hint(str(error), "error")
        self._end()
        return None

    @property
    def at_leisure(self) -> bool:
        """Whether there is something to `reflect` on, and nobody who would wait meanwhile."""
        return self._reflection is not None and self.going is None and not self.pen.down

    def reflect(self) -> None:
        """Go on, for some hundredths of a second, to measure what has emerged in the network."""
        try:
            next(self._reflection or iter(()))
        except (StopIteration, MotioneseError) as ended:
            self._reflection = None
            if isinstance(ended, MotioneseError):
                self._hint(str(ended), "error")

    def _reflected(self) -> Iterator[None]:
        yield from self.teaching.measured()
        self._folder.save(self.teaching)
        self._tell(descriptions.emergence_message(self.teaching.emerged))
        self._robots.tell_all()

    def _end(self) -> None:
        self.going = None
        if self._busy:
            self.tell_session("")

    def _hint(self, sentence: str, kind: str = "hint") -> None:
        self._tell({"type": "told", "kind": kind, "sentence": sentence})

    def _draw(self, message: dict[str, Any]) -> None:
        if message["phase"] == "down":
            self.pen.set_down(message["source"], message["follow"])
        self.pen.move(message["points"])
        if message["phase"] == "up" and self.pen.down:
            hint = ""
            try:
                path, drawn, hint = self.pen.finished()
                self._show(path, drawn, self.pen.source, message["received"])
            except DrawingError as error:
                hint = str(error)
            except MotioneseError as error:
                self._hint(str(error), "error")
            if hint:
                self._hint(hint)

    def _show(
        self, path: Float[ndarray, "T 3"], drawn: Float[ndarray, "R 3"], source: Source, end: float
    ) -> None:
        # This needs no network: it is there at once, and whether it can be done comes after it.
        self._tell(descriptions.saw_message(self.teaching.seen(path)))
        observed = self.teaching.show(path, source, drawn)
        self._tell(descriptions.verdict_message(observed, self._view, time.monotonic() - end))
        self._save()

    def _save(self) -> None:
        end_chapters(self.teaching)
        self._folder.save(self.teaching)
        self.tell_session()

    def _demonstrate(self, message: dict[str, Any]) -> Iterator[float]:
        scene = self.teaching.scene
        manner = scene.manner
        try:
            sequence = scene.task.sequence(message["motion"])
            if manner.rows(sequence) > most_rows(manner):
                raise TaskError(f"{sequence.name} is too long to be shown")
        except TaskError as error:
            self._hint(str(error), "refusal")
            return
        self.tell_session("demonstrating")
        rng = generator_for(scene.seed, "shown", self.teaching.notebook.next)
        path = scene.caregiver().demonstrate(sequence, rng).path
        step = 1000 / scene.body.rate_hz
        self._tell(descriptions.shown_message(sequence.name, self._view.of_points(path), step))
        self.pen.lift()
        self.pen.begin()
        rows = round(GHOST_S * scene.body.rate_hz)
        for row in range(rows, len(path), rows):
            yield GHOST_S
            self.pen.tell_understood(path[:row], round(step * row))
        yield GHOST_S
        self._show(path, path, "scripted", time.monotonic())

    def _imitate(self, message: dict[str, Any]) -> Iterator[float]:
        teaching = self.teaching
        if teaching.observed is None:
            self._hint(NOTHING_SHOWN)
            return
        self.tell_session("performing")
        trial = teaching.imitate()
        entry = teaching.observed.entry
        self._save()
        yield from descriptions.show_film(self._film(trial), self._tell)
        path = self._view.of_points(trial.performance.path)
        rate_hz = teaching.scene.body.rate_hz
        self._tell(descriptions.performed_message(entry, trial, path, rate_hz))

    def _learn(self, message: dict[str, Any]) -> Iterator[float]:
        observed = self.teaching.observed
        if observed is None:
            self._hint(NOTHING_SHOWN)
            return
        self.tell_session("learning")
        yield 0.0
        tries: list[Trial] = []

        def tried(trial: Trial) -> None:
            whole = self._whole_film(trial, observed.entry)
            self._tell({"type": "practice", "attempt": len(tries), "of": PRACTICE, **whole})
            tries.append(trial)

        lesson = self._changed(
            lambda report: self.teaching.learn(report, tried, self._between), "learning"
        )
        self._tell(descriptions.learned_message(lesson))

    def _repeat(self, message: dict[str, Any]) -> Iterator[float]:
        """Have the lessons of another robot, with the same demonstrations."""
        name, left = self._robots.lessons_of(message["robot"])
        if not left:
            self._hint("This robot has had all those lessons.")
        for number, shown in enumerate(left, 1):
            self._hint(f"Lesson {number} of {len(left)}, as {name} had it.")
            if (entry := self.teaching.notebook.entry_like(shown)) is None:
                path = shown.demonstration.path
                self._show(path, shown.drawn, shown.source, time.monotonic())
            else:
                self.teaching.look_back(entry.number)
            yield from self._learn(message)

    def _replay(self, message: dict[str, Any]) -> Iterator[float]:
        observed = self.teaching.look_back(message["entry"])
        if observed is None:
            self._hint(NOT_THERE)
            return
        entry = observed.entry
        if entry.tried is None:
            self._hint("I have not tried this yet: press Imitate to see me try.")
        else:
            whole = self._whole_film(entry.tried, entry)
            self._tell({"type": "replayed", "attempt": len(entry.errors_cm), **whole})
        self.tell_session()
        yield 0.0

    def _rename(self, message: dict[str, Any]) -> Iterator[float]:
        rename(self.teaching, message["motion"], message["name"])
        if self._map is not None:
            self._map.named_as(self.teaching.notebook)
            self._tell(descriptions.map_message(self._map))
        self._save()
        if self.teaching.observed is not None:
            self._tell(descriptions.verdict_message(self.teaching.observed, self._view, 0.0))
        yield 0.0

    def _film(self, trial: Trial) -> Film:
        rate_hz = self.teaching.scene.body.rate_hz
        return film(self._geometry, trial.levels, trial.performance, rate_hz)

    def _whole_film(self, trial: Trial, entry: Entry) -> Answer:
        """Return a try as it is played: the film, its hand and what was shown in the view."""
        played, view, rate_hz = self._film(trial), self._view, self.teaching.scene.body.rate_hz
        return descriptions.whole_film(played, trial, entry, view, rate_hz)

    def _grow(self, message: dict[str, Any]) -> Iterator[float]:
        if not self.teaching.can_grow:
            self._hint("All levels are open already.")
            return
        self.tell_session("growing")
        yield 0.0
        changes = self._changed(lambda report: self.teaching.grow(report, self._between), "growing")
        self._tell(descriptions.grown_message(changes, self.teaching.learner.network))

    def _changed(self, change: Callable[[Report], T], what: str) -> T:
        """Let the network change; a person who stops it finds all as it was before."""

        def report(done: int, of: int, now: Progress) -> None:
            self._tell(descriptions.progress_message(what, done, of, now))
            self._between()

        before = self.teaching.standing
        try:
            result = change(report)
        except (StoppedError, MotioneseError):
            self.teaching.return_to(before)
            raise
        self._network_changed()
        self._save()
        return result

    def _between(self) -> None:
        """Hear, between one thing and the next, whether the person wants it to end."""
        if self._stop_asked():
            raise StoppedError

    def _forget(self, message: dict[str, Any]) -> Iterator[float]:
        said = self.teaching.forget(message["entry"], self._folder.learner)
        self._network_changed()
        self._save()
        self._hint(said or NOT_THERE)
        yield 0.0

    def _draw_map(self, message: dict[str, Any]) -> Iterator[float]:
        teaching = self.teaching
        self._map = self._map or InteractiveMap(teaching.scene, teaching.learner)
        self._tell(descriptions.map_message(self._map))
        yield 0.0

    def _hover(self, message: dict[str, Any]) -> None:
        if self._map is None or self._busy:
            return
        path = self._map.motion(message["primitive"], message["slow"])
        if path is not None:
            at = {"slow": message["slow"], "primitive": message["primitive"]}
            seen = descriptions.listed(self._view.of_points(path))
            self._tell({"type": "hovered", **at, "path": seen})
            self._pointed_at.add(tuple(message["slow"]))
            if len(self._pointed_at) >= EXPLORED and end_chapters(self.teaching, MAP):
                self._save()
