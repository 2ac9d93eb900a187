"""A session's folder: written whole after every change, so that a kill at any moment loses nothing.

`session.json` names the files that belong to it; what it does not name is left over and removed.
"""

import io
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any
from uuid import uuid4
from zipfile import BadZipFile

import numpy as np

from motionese.errors import StorageError
from motionese.experiment import Learner, Scene
from motionese.experiment.checkpoint import read_learner, write_learner
from motionese.experiment.reading import checked
from motionese.files import write_whole
from motionese.recordings import write
from motionese.teaching.beginning import BABBLING, begun_by_babbling, begun_in, begun_with
from motionese.teaching.demonstrations import recording_of
from motionese.teaching.files_kept import DEMONSTRATIONS, SESSION
from motionese.teaching.notebook import Entry, Learned, Notebook
from motionese.teaching.session import Teaching

FORMAT, VERSION = "motionese-teaching", 1


class SessionFolder:
    """Where a session is kept.

    Attributes:
        path: The folder.
        id: A name of the session that no other has.
        began: What its robot began from.
    """

    def __init__(self, path: Path) -> None:
        """Keep a session in a folder, which is made when it is first saved."""
        self.path = path
        self.id, self.began = uuid4().hex[:12], ""
        self._written: Learner | None = None

    @property
    def exists(self) -> bool:
        """Whether there is a session to go on with."""
        return (self.path / SESSION).is_file()

    def begun(self, begin: str) -> Teaching:
        """Return the session to go on with, or a new one.

        Args:
            begin: "babbling", "fresh" or the path of a run; empty for what is there, or babbling.

        Raises:
            StorageError: What is in the folder is no session, or it began from something else.
            RunFolderError: No such run.
        """
        if self.exists:
            teaching = self._read()
            if begin and begin != self.began:
                raise StorageError(
                    f"{self.path}: this session began from {self.began}, not from {begin}; "
                    "choose another --session"
                )
            return teaching
        if self.path.exists() and any(self._foreign()):
            raise StorageError(f"{self.path} is not empty and no session; choose another --session")
        self.began = begin or BABBLING
        if self.began in (BABBLING, "fresh"):
            scene = Scene(*begun_by_babbling())
            teaching = Teaching(scene, begun_with(self.began, scene), Notebook())
        else:
            run = begun_in(Path(begin))
            teaching = Teaching(Scene(run.settings, run.seed), run.learner, Notebook())
        self.save(teaching)
        return teaching

    def begun_anew(self, begin: str, before: Teaching) -> Teaching:
        """Return a new session with the same settings; the one before is kept in a subfolder."""
        number = len(list(self.path.glob("earlier-*"))) + 1
        earlier = self.path / f"earlier-{number:02d}"
        earlier.mkdir()
        # The session's own file goes last: until then it names files that are still found.
        own = [*self.path.glob("*.npz"), *self.path.glob("*.safetensors"), self.path / SESSION]
        learner = begun_with(begin, before.scene)
        for file in own:
            file.rename(earlier / file.name)
        self.id, self.began, self._written = uuid4().hex[:12], begin, None
        teaching = Teaching(before.scene, learner, Notebook())
        self.save(teaching)
        return teaching

    def save(self, teaching: Teaching) -> None:
        """Write what has changed."""
        try:
            self.path.mkdir(parents=True, exist_ok=True)
            if teaching.learner is not self._written:
                teaching.kept += 1
                write_learner(self._learner_path(teaching.kept), teaching.learner, {})
                self._written = teaching.learner
            for entry in teaching.notebook.entries:
                path = self._entry_path(entry.number)
                if not path.is_file():
                    content = io.BytesIO()
                    np.savez(content, drawn=entry.drawn, path=entry.path)
                    write_whole(path, content.getvalue())
            recording = recording_of(teaching.notebook.entries, teaching.scene.body.rate_hz)
            if recording is not None:
                write(self.path / DEMONSTRATIONS, recording)
            write_whole(self.path / SESSION, json.dumps(self._facts(teaching), indent=1))
            self._remove_what_is_left_over(teaching)
        except OSError as error:
            raise StorageError(f"{self.path} cannot be written to: {error.strerror}") from error

    def learner(self, number: int) -> Learner:
        """Return a learner that was kept."""
        return read_learner(self._learner_path(number))[0]

    def _facts(self, teaching: Teaching) -> dict[str, Any]:
        entries = [
            {name: value for name, value in vars(entry).items() if name not in ("drawn", "path")}
            for entry in teaching.notebook.entries
        ]
        return {
            "format": FORMAT,
            "version": VERSION,
            "id": self.id,
            "began": self.began,
            "seed": teaching.scene.seed,
            "kept": teaching.kept,
            "next": teaching.notebook.next,
            "entries": entries,
            "learned": [asdict(each) for each in teaching.notebook.learned],
            "settings": teaching.scene.settings.model_dump(mode="json"),
        }

    def _read(self) -> Teaching:
        file = self.path / SESSION
        try:
            facts = json.loads(file.read_text())
            if facts.get("format") != FORMAT:
                raise StorageError(f"{file} was not written by motionese")
            if facts.get("version") != VERSION:
                raise StorageError(
                    f"{file}: session of format {facts.get('version')}, this version of motionese "
                    f"reads {VERSION}; install a newer one"
                )
            self.id, self.began = str(facts["id"]), str(facts["began"])
            notebook = Notebook(
                entries=tuple(self._entry(each) for each in facts["entries"]),
                learned=tuple(Learned(**each) for each in facts["learned"]),
                next=int(facts["next"]),
            )
            kept, seed = int(facts["kept"]), int(facts["seed"])
            scene = Scene(checked(facts["settings"]), seed)
        except (OSError, ValueError, KeyError, TypeError, AttributeError, BadZipFile) as e:
            raise StorageError(f"{self.path}: no session that can be read; it was changed") from e
        self._written = self.learner(kept)
        return Teaching(scene, self._written, notebook, kept)

    def _entry(self, facts: dict[str, Any]) -> Entry:
        with np.load(self._entry_path(facts["number"]), allow_pickle=False) as arrays:
            return Entry(
                **{**facts, "errors_cm": tuple(facts["errors_cm"])},
                drawn=arrays["drawn"],
                path=arrays["path"],
            )

    def _entry_path(self, number: int) -> Path:
        return self.path / f"shown-{int(number):04d}.npz"

    def _learner_path(self, number: int) -> Path:
        return self.path / f"learner-{number:05d}.safetensors"

    def _foreign(self) -> list[Path]:
        return [p for p in self.path.iterdir() if not p.name.startswith(".")]

    def _remove_what_is_left_over(self, teaching: Teaching) -> None:
        notebook = teaching.notebook
        kept = {teaching.kept, *(each.before for each in notebook.learned)}
        named = {self._learner_path(number) for number in kept}
        named |= {self._entry_path(entry.number) for entry in notebook.entries}
        for pattern in ("learner-*.safetensors", "shown-*.npz"):
            for path in set(self.path.glob(pattern)) - named:
                path.unlink(missing_ok=True)
        if not notebook.entries:
            (self.path / DEMONSTRATIONS).unlink(missing_ok=True)
