"""Up to three robots of one session: each with its own network, notebook and growth."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from motionese.caregiver import Demonstration
from motionese.errors import MotioneseError, StorageError
from motionese.teaching.notebook import Entry, Notebook
from motionese.teaching.packed_session import read_taught, write_taught
from motionese.teaching.result import Result
from motionese.teaching.session import Teaching
from motionese.teaching.session_contents import (
    LONGEST_NAME,
    PLACES,
    Growth,
    contents,
    put_away,
    replace_contents,
    robots_in,
)
from motionese.teaching.session_folder import SessionFolder

MOST = len(PLACES)
FULL = f"{MOST} robots are as many as a session has: choose the one to be put away."


class NoPlaceError(MotioneseError):
    """A session has as many robots as it can have."""


@dataclass
class Pupil:
    """A robot of the session: where it is kept, what it is, and what it came to when compared.

    Attributes:
        compared: Its results at the motions of the last comparison.
        compared_as: The number of the learner that had them.
    """

    folder: SessionFolder
    teaching: Teaching
    compared: dict[str, Result] | None = None
    compared_as: int = 0

    @property
    def results(self) -> dict[str, Result] | None:
        """What it came to when compared; None if it was not, or has learned since."""
        return self.compared if self.compared_as == self.teaching.standing.number else None


class School:
    """The robots of a session's folder, one of which is being taught.

    The first lies in the folder itself, the others in subfolders, each whole after every change.

    Attributes:
        home: The session's folder.
        pupils: The robots; at most `MOST`.
        taught: Which of them is being taught.
    """

    def __init__(self, folder: SessionFolder, teaching: Teaching) -> None:
        """Go on with a session whose first robot was read.

        Raises:
            StorageError: Another robot of it cannot be read.
        """
        self.home = folder.path
        self.pupils = [Pupil(folder, teaching)]
        for place in robots_in(self.home)[1:]:
            other = SessionFolder(self.home / place)
            self.pupils.append(Pupil(other, other.read(scene=teaching.scene)))
        taught = self.home / read_taught(self.home)
        self.taught = next((p for p in self.pupils if p.folder.path == taught), self.pupils[0])

    def pupil(self, name: str) -> Pupil:
        """Return a robot by its session's id; `MotioneseError` where there is none."""
        for pupil in self.pupils:
            if pupil.folder.id == name:
                return pupil
        raise MotioneseError("This robot is not in the session any more.")

    def teach(self, pupil: Pupil) -> None:
        """Teach a robot from now on."""
        self.taught = pupil
        place = pupil.folder.path.relative_to(self.home).as_posix()
        try:
            write_taught(self.home, "" if place == "." else place)
        except OSError as error:
            raise StorageError(f"{self.home} cannot be written to: {error.strerror}") from error

    def call(self, pupil: Pupil, name: str) -> None:
        """Give a robot a name."""
        pupil.folder.name = _plain(name) or pupil.folder.name
        pupil.folder.save(pupil.teaching)

    def begin(self, began: str, grows: Growth, name: str = "", away: Pupil | None = None) -> Pupil:
        """Begin with a further robot, which is taught from now on.

        Args:
            began: "babbling" or "fresh".
            grows: When it opens its slow level.
            name: What it is called; a name that no other has where left out.
            away: The robot that is put away for it.

        Raises:
            NoPlaceError: There are `MOST` robots, and none is put away.
            StorageError: It cannot be kept.
        """
        name = _plain(name) or self._new_name(away)
        before = self.taught.teaching
        if away is not None:
            folder = SessionFolder(away.folder.path, name, grows)
            new = Pupil(folder, folder.begin_anew(began, away.teaching, self.home))
            self.pupils[self.pupils.index(away)] = new
        else:
            folder = SessionFolder(self.home / self._free_place(), name, grows)
            new = Pupil(folder, folder.begin(began, before.scene))
            self.pupils.append(new)
        self.teach(new)
        return new

    def compare(self) -> Iterator[tuple[int, int]]:
        """Let every robot try every motion that any was shown; yields tries done, and how many."""
        known: dict[str, Demonstration] = {}
        for pupil in self.pupils:
            known |= pupil.teaching.demonstrations()
        done, of = 0, len(known) * len(self.pupils)
        for pupil in self.pupils:
            results: dict[str, Result] = {}
            for motion, shown in known.items():
                results[motion] = pupil.teaching.result_at(motion, shown)
                done += 1
                yield done, of
            pupil.compared, pupil.compared_as = results, pupil.teaching.standing.number

    def _new_name(self, away: Pupil | None) -> str:
        names = {pupil.folder.name for pupil in self.pupils if pupil is not away}
        return next(n for i in range(1, MOST + 2) if (n := f"Robot {i}") not in names)

    def _free_place(self) -> str:
        """Return where a robot can be kept; what a killed process has left there is removed."""
        taken = robots_in(self.home)
        for place in PLACES:
            if place not in taken:
                for name in contents(self.home, [place]):
                    (self.home / name).unlink()
                return place
        raise NoPlaceError(FULL)


def read_school(folder: Path) -> School:
    """Return a session as it lies in a folder; `StorageError` where it is none."""
    first = SessionFolder(folder)
    return School(first, first.read())


def check_opened(folder: Path, called: str) -> None:
    """Read a session that was unpacked into a folder.

    Raises:
        StorageError: It cannot be read; it is called by where it came from.
    """
    try:
        read_school(folder)
    except StorageError as error:
        why, _, _ = str(error).replace(f"{folder}/", "").partition(";")
        raise StorageError(f"{called} cannot be opened: {why}") from error


def exchange(school: School, opened: Path) -> School:
    """Put a session away, and return the one that lies in a subfolder of its folder in its place.

    Raises:
        StorageError: That is no session; nothing has changed.
    """
    check_opened(opened, "This session")
    try:
        put_away(school.home, school.home)
        replace_contents(school.home, opened)
    except OSError as error:
        raise StorageError(f"{school.home} cannot be written to: {error.strerror}") from error
    return read_school(school.home)


def lessons(notebook: Notebook) -> list[Entry]:
    """Return what was practised, in order; a motion as often as it was."""
    entries = {entry.number: entry for entry in notebook.entries}
    return [entries[each.entry] for each in notebook.learned if each.entry in entries]


def lessons_left(notebook: Notebook, other: Notebook) -> list[Entry]:
    """Return the lessons of another robot that one has not had, by what was shown."""
    had = [entry.demonstration.path.tobytes() for entry in lessons(notebook)]
    left = []
    for entry in lessons(other):
        shown = entry.demonstration.path.tobytes()
        if shown in had:
            had.remove(shown)
        else:
            left.append(entry)
    return left


def _plain(name: str) -> str:
    return " ".join(name.split())[:LONGEST_NAME]
