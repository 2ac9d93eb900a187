"""A session's folder: written whole after every change, so that a kill at any moment loses nothing.

`session.json` names the files that belong to it; what it does not name is left over and removed.
"""

import io
import json
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any, get_args
from uuid import uuid4
from zipfile import BadZipFile

import numpy as np

from motionese.caregiver import DEMONSTRATIONS, Demonstration, moving, recording_of, sequence_in
from motionese.errors import StorageError
from motionese.files import write_whole
from motionese.imitation import (
    BABBLING,
    Learner,
    Scene,
    Settings,
    babbled,
    checked,
    newborn,
    read_learner,
    write_learner,
)
from motionese.recordings import write
from motionese.teaching.emergence import Direction, Emergence, Following, Reading
from motionese.teaching.notebook import Change, Entry, Learning, Notebook
from motionese.teaching.session import Teaching
from motionese.teaching.session_contents import LONGEST_NAME, SESSION, Growth, origins, put_away
from motionese.teaching.trial_file import read_trial, write_trial

FORMAT, VERSION = "motionese-teaching", 3
FRESH = "fresh"
CHANGED = (
    OSError,
    EOFError,
    ValueError,
    KeyError,
    TypeError,
    AttributeError,
    BadZipFile,
    RecursionError,
)
"""What reading a file meets that was changed since it was written."""
LEVELS = 2
"""Levels of a robot at the beginning: input and output, and the fastest context."""
FIRST = "Robot 1"
"""The name of a robot that was given none."""


class SessionFolder:
    """Where a session is kept.

    Attributes:
        id: A name of the session that no other has.
        began: What its robot began from.
        name: What a person calls the robot.
        grows: When it opens its slow level.
    """

    def __init__(self, path: Path, name: str = FIRST, grows: Growth = "told") -> None:
        """Keep a session in a folder, which is made when it is first saved."""
        self.path, self.name, self.grows = path, name, grows
        self.id, self.began = uuid4().hex[:12], ""
        # What this process knows to be written: the learner's number, and the entries' files. One
        # that a killed process has left under a number that was not yet given counts for nothing.
        self._written, self._entries = 0, set[Path]()

    @property
    def exists(self) -> bool:
        """Whether there is a session to go on with."""
        return (self.path / SESSION).is_file()

    def begin(self, began: str, scene: Scene, learner: Learner | None = None) -> Teaching:
        """Begin a session.

        Args:
            began: "babbling", "fresh", or what the learner comes from.
            learner: What it is; where left out one that has babbled, or has done nothing yet.

        Raises:
            StorageError: There are other files in the folder.
        """
        if self.path.exists() and any(not p.name.startswith(".") for p in self.path.iterdir()):
            raise StorageError(f"{self.path} is not empty and no session; choose another --session")
        teaching = Teaching(scene, learner or self._new(began, scene), grows=self._may_grow)
        self.began = began
        self.save(teaching)
        return teaching

    def begin_anew(self, began: str, before: Teaching, home: Path | None = None) -> Teaching:
        """Begin a session with the same settings; the one before is put away in a subfolder.

        Args:
            began: "babbling" or "fresh".
            before: The session that ends.
            home: Whose subfolder that is, where it is not this folder's.
        """
        learner = self._new(began, before.scene)
        put_away(home or self.path, self.path, [""])
        self.id, self.began = uuid4().hex[:12], began
        self._written, self._entries = 0, set()
        # A number that the session before has not given: until this one is written whole, that one
        # is still there with all its learners.
        number = before.numbers + 1
        anew = Teaching(before.scene, learner, number=number, numbers=number, grows=self._may_grow)
        self.save(anew)
        return anew

    def read(self, begin: str = "", scene: Scene | None = None) -> Teaching:
        """Return the session to go on with.

        Args:
            begin: What it, or one that was put away, must have begun from; anything where empty.
            scene: Where it may go on, if its settings are the same.

        Raises:
            StorageError: What is in the folder is no session, or it began from something else.
        """
        file = self.path / SESSION
        with _whole(file):
            facts = json.loads(file.read_text())
            if facts.get("format") != FORMAT:
                raise StorageError(f"{file} was not written by motionese")
            if facts.get("version") != VERSION:
                raise StorageError(
                    f"{file}: session of format {facts.get('version')}, this version of motionese "
                    f"reads {VERSION}; go on with the version that wrote it, or choose another "
                    "--session"
                )
            self.id, self.began = str(facts["id"]), str(facts["began"])
            self.name, self.grows = _robot(facts)
            number, numbers, seed = (int(facts[name]) for name in ("learner", "learners", "seed"))
            settings = checked(Settings, facts["settings"])
            notebook = Notebook(
                entries=tuple(self._entry(each) for each in facts["entries"]),
                learned=tuple(_learning(each) for each in facts["learned"]),
                next=int(facts["next"]),
                # Sessions of before there were chapters and names are read as well.
                ended=frozenset(facts.get("ended", ())),
                renamed=tuple((old, new) for old, new in facts.get("renamed", ())),
            )
            emerged = tuple(_emergence(each) for each in facts.get("emerged", ()))
        if begin and begin not in {self.began, *origins(self.path)}:
            raise StorageError(
                f"{self.path}: this session began from {self.began}, not from {begin}; "
                "choose another --session"
            )
        self._written = number
        self._entries = {file for entry in notebook.entries for file in self._files_of(entry)}
        if scene is None or (scene.settings, scene.seed) != (settings, seed):
            scene = Scene(settings, seed)
        return Teaching(
            scene,
            self.learner(number),
            notebook,
            number=number,
            numbers=numbers,
            grows=self._may_grow,
            emerged=emerged,
        )

    def save(self, teaching: Teaching) -> None:
        """Write what has changed; the session stays as it is."""
        number, notebook = teaching.standing.number, teaching.notebook
        rate_hz = teaching.scene.body.rate_hz
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            if number != self._written:
                write_learner(self._learner_path(number), teaching.learner, rate_hz, {})
                self._written = number
            for entry in notebook.entries:
                self._write(entry)
            drawn = ((_shows(entry, teaching.scene), entry.drawn) for entry in notebook.entries)
            recording = recording_of(drawn, rate_hz)
            if recording is not None:
                write(self.path / DEMONSTRATIONS, recording)
            write_whole(self.path / SESSION, json.dumps(self._facts(teaching), indent=1))
            self._remove_what_is_left_over(teaching)
        except OSError as error:
            raise StorageError(f"{self.path} cannot be written to: {error.strerror}") from error

    def learner(self, number: int) -> Learner:
        """Return the learner of a number that was kept."""
        return read_learner(self._learner_path(number))[0]

    @property
    def _may_grow(self) -> bool:
        return self.grows != "never"

    def _new(self, began: str, scene: Scene) -> Learner:
        levels = len(scene.settings.network.levels) if self.grows == "beginning" else LEVELS
        learner = newborn(scene, levels)
        return babbled(scene, learner) if began == BABBLING else learner

    def _write(self, entry: Entry) -> None:
        """Write what was shown, and the last try at it."""
        shown_in, tried_in = self._files_of(entry)
        if shown_in not in self._entries:
            content, shown = io.BytesIO(), entry.demonstration
            np.savez(content, drawn=entry.drawn, path=shown.path, begins=shown.begins)
            write_whole(shown_in, content.getvalue())
        if entry.tried and tried_in not in self._entries:
            write_trial(tried_in, entry.tried)
        self._entries |= {shown_in, tried_in}

    def _facts(self, teaching: Teaching) -> dict[str, Any]:
        names = ("number", "motion", "source", "errors_cm")
        entries = [{n: getattr(entry, n) for n in names} for entry in teaching.notebook.entries]
        own = set(Settings.model_fields)
        settings = teaching.scene.settings.model_dump(mode="json", include=own)
        return {
            "format": FORMAT,
            "version": VERSION,
            "id": self.id,
            "began": self.began,
            "name": self.name,
            "grows": self.grows,
            "seed": teaching.scene.seed,
            "learner": teaching.standing.number,
            "learners": teaching.numbers,
            "next": teaching.notebook.next,
            "ended": sorted(teaching.notebook.ended),
            "renamed": teaching.notebook.renamed,
            "entries": entries,
            "learned": [asdict(each) for each in teaching.notebook.learned],
            "emerged": [asdict(each) for each in teaching.emerged],
            "settings": settings,
        }

    def _entry(self, facts: dict[str, Any]) -> Entry:
        errors = tuple(facts["errors_cm"])
        shown_in, tried_in = self._paths(facts["number"], len(errors))
        with _whole(shown_in), shown_in.open("rb") as file:
            arrays = np.load(file, allow_pickle=False)
            begins = tuple(int(row) for row in arrays["begins"])
            shown, drawn = Demonstration(arrays["path"], begins), arrays["drawn"]
        with _whole(tried_in):
            tried = read_trial(tried_in) if errors else None
        return Entry(
            **{**facts, "errors_cm": errors}, drawn=drawn, demonstration=shown, tried=tried
        )

    def _files_of(self, entry: Entry) -> tuple[Path, Path]:
        return self._paths(entry.number, len(entry.errors_cm))

    def _paths(self, number: int, tries: int) -> tuple[Path, Path]:
        """Return the files of what was shown, and of the last of so many tries at it."""
        shown, tried = f"shown-{int(number):04d}.npz", f"tried-{int(number):04d}-{tries:05d}.npz"
        return self.path / shown, self.path / tried

    def _learner_path(self, number: int) -> Path:
        return self.path / f"learner-{number:05d}.safetensors"

    def _remove_what_is_left_over(self, teaching: Teaching) -> None:
        notebook = teaching.notebook
        kept = {teaching.standing.number, *(each.before for each in notebook.learned)}
        named = {self._learner_path(number) for number in kept}
        named |= {file for entry in notebook.entries for file in self._files_of(entry)}
        self._entries &= named
        for pattern in ("learner-*.safetensors", "shown-*.npz", "tried-*.npz"):
            for path in set(self.path.glob(pattern)) - named:
                path.unlink(missing_ok=True)
        if not notebook.entries:
            (self.path / DEMONSTRATIONS).unlink(missing_ok=True)


def _robot(facts: dict[str, Any]) -> tuple[str, Growth]:
    """Return a robot's name, and when it grows."""
    name, grows = str(facts.get("name", FIRST)), facts.get("grows", "told")
    if grows not in get_args(Growth):
        raise ValueError(f"grows {grows!r}")
    return name[:LONGEST_NAME], grows


def _learning(facts: dict[str, Any]) -> Learning:
    return Learning(**{**facts, "changes": tuple(Change(**each) for each in facts["changes"])})


def _emergence(facts: dict[str, Any]) -> Emergence:
    return Emergence(
        learner=facts["learner"],
        levels=tuple(facts["levels"]),
        directions=tuple(Direction(**each) for each in facts["directions"]),
        first=Following(**facts["first"]),
        order=Following(**facts["order"]),
        read=tuple(Reading(**each) for each in facts["read"]),
    )


@contextmanager
def _whole(file: Path) -> Iterator[None]:
    """Say which file of a session is not as it was written, and what can be done."""
    try:
        yield
    except CHANGED as error:
        why = error.strerror if isinstance(error, OSError) else f"it was changed ({error})"
        raise StorageError(
            f"{file} cannot be read: {why}; put the file back as it was, or choose another "
            "--session"
        ) from error


def _shows(entry: Entry, scene: Scene) -> str:
    """Return what a drawing shows, as `caregiver.read_recorded` will read it."""
    hand = moving(entry.drawn, scene.settings.caregiver.rest_steps)
    sequence = sequence_in(hand, scene.task)
    return sequence.name if sequence else entry.motion
