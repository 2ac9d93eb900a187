"""The robots of a session, as the page knows them: begun, switched, named, compared, exchanged."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from motionese.interfaces.page.messages import Answer, Tell
from motionese.teaching.chapters import end_chapters
from motionese.teaching.notebook import Entry
from motionese.teaching.packed_session import SUFFIX
from motionese.teaching.school import MOST, Pupil, School, exchange, lessons, lessons_left
from motionese.teaching.session import Teaching
from motionese.teaching.session_contents import OPENED

if TYPE_CHECKING:
    from motionese.interfaces.page.robot import Robot

NOTHING_TO_COMPARE = "There is nothing to compare yet: show a motion first."
NOT_SENT = f"This file is not here any more: open the {SUFFIX} file again."


class Robots:
    """What is done with more robots than the one that is taught."""

    def __init__(self, robot: Robot, school: School, tell: Tell) -> None:
        """Serve a school; `robot` does what the taught one does."""
        self._robot, self.school, self._tell = robot, school, tell
        self._told: Answer = {}
        self._warm: set[tuple[int, ...]] = set()
        self.does: dict[str, Callable[[dict[str, Any]], Iterator[float]]] = {
            "begin": self._begin,
            "teach": self._teach,
            "call": self._call,
            "compare": self._compare,
            "open": self._open,
        }

    def tell_all(self) -> None:
        """Tell which robots there are, where that has changed."""
        told = robots_message(self.school)
        if told != self._told:
            self._told = told
            self._tell(told)

    def lessons_of(self, robot: str) -> tuple[str, list[Entry]]:
        """Return a robot's name, and its lessons that the taught one has not had."""
        taught, other = self.school.taught, self.school.pupil(robot)
        return other.folder.name, lessons_left(taught.teaching.notebook, other.teaching.notebook)

    def warm_up(self) -> None:
        """Let what the taught robot asks for be compiled, if no other of its size has done it.

        What is imitated next is what is shown, also after the process was killed.
        """
        teaching = self._robot.teaching
        sizes = tuple(teaching.learner.network.sizes)
        if sizes not in self._warm:
            teaching.warm_up()
            self._warm.add(sizes)
        if teaching.observed is None and teaching.notebook.entries:
            teaching.look_back(teaching.notebook.entries[-1].number)
            self._robot.tell_session()

    def _hint(self, sentence: str) -> None:
        self._tell({"type": "told", "kind": "hint", "sentence": sentence})

    def _become(self, pupil: Pupil) -> Iterator[float]:
        """Switch to a robot: the page shows it first, then what is not compiled yet is."""
        self._robot.become(pupil)
        self._tell({"type": "begun"})
        self._robot.tell_session("waking up")
        yield 0.0
        self.warm_up()

    def _begin(self, message: dict[str, Any]) -> Iterator[float]:
        school = self.school
        away = school.pupil(message["away"]) if message["away"] else None
        self._robot.tell_session("beginning anew")
        yield 0.0
        ended = school.taught.teaching.notebook.ended
        new = school.begin(message["with"], message["grows"], message["name"], away)
        end_chapters(new.teaching, *ended)
        new.folder.save(new.teaching)
        yield from self._become(new)
        gone = f" {away.folder.name} is put away in the session's folder." if away else ""
        self._hint(f"You are teaching {new.folder.name} now.{gone}")

    def _teach(self, message: dict[str, Any]) -> Iterator[float]:
        pupil = self.school.pupil(message["robot"])
        if pupil is not self.school.taught:
            self.school.teach(pupil)
            yield from self._become(pupil)

    def _call(self, message: dict[str, Any]) -> Iterator[float]:
        self.school.call(self.school.pupil(message["robot"]), message["name"])
        self.tell_all()
        yield 0.0

    def _compare(self, message: dict[str, Any]) -> Iterator[float]:
        self._robot.tell_session("comparing")
        yield 0.0
        done = 0
        for done, of in self.school.compare():
            self._tell({"type": "progress", "what": "comparing", "done": done, "of": of})
            yield 0.0
        if not done:
            self._hint(NOTHING_TO_COMPARE)

    def _open(self, message: dict[str, Any]) -> Iterator[float]:
        opened = self.school.home / f"{OPENED}{message['file']}"
        if not opened.is_dir():
            self._hint(NOT_SENT)
            return
        self._robot.tell_session("opening a session")
        yield 0.0
        self.school = exchange(self.school, opened)
        self._robot.become(self.school.taught)
        self._robot.introduce()
        yield from self._become(self.school.taught)
        self._hint("The session is open. The one before is put away in the session's folder.")


def robots_message(school: School) -> Answer:
    """Return all robots of a session side by side, as far as they were compared."""
    taught = school.taught
    return {
        "type": "robots",
        "taught": taught.folder.id,
        "most": MOST,
        "robots": [{**_facts(pupil), "left": _left(taught, pupil)} for pupil in school.pupils],
    }


def _facts(pupil: Pupil) -> Answer:
    notebook, network = pupil.teaching.notebook, pupil.teaching.learner.network
    return {
        "id": pupil.folder.id,
        "name": pupil.folder.name,
        "began": pupil.folder.began,
        "grows": pupil.folder.grows,
        "levels": [level.name for level in network.levels],
        "lessons": len(lessons(notebook)),
        "clear": _clear(pupil.teaching),
        **_compared(pupil),
    }


def _clear(teaching: Teaching) -> str:
    """Return how many strokes are clear in a network with a slow level, if that is measured."""
    emerged = teaching.emerged
    if not emerged or emerged[-1].learner != teaching.standing.number or not emerged[-1].slow:
        return ""
    clear = [each.clear for each in emerged[-1].directions]
    return f"{sum(clear)} of {len(clear)}"


def _compared(pupil: Pupil) -> Answer:
    """Return what a robot came to when compared; None for what is not known."""
    results = pupil.results
    if not results:
        return {"can": None, "of": None, "error_cm": None, "tries": None}
    return {
        "can": sum(result.good for result in results.values()),
        "of": len(results),
        "error_cm": round(float(np.mean([each.error_cm for each in results.values()])), 2),
        "tries": [
            {"motion": motion, "error_cm": round(result.error_cm, 2), "good": result.good}
            for motion, result in results.items()
        ],
    }


def _left(taught: Pupil, other: Pupil) -> int:
    """Return how many lessons of another robot the taught one has not had."""
    return len(lessons_left(taught.teaching.notebook, other.teaching.notebook))
