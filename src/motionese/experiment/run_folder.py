"""A run folder: its settings, what it was made with, a folder per run; written by one process.

Everything is written whole, and the lock is the operating system's: after a kill at any moment
the folder is free, and holds what was finished.
"""

import json
import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from filelock import FileLock, Timeout

from motionese.errors import RunFolderError, StorageError
from motionese.experiment.conditions import Condition
from motionese.experiment.digests import DIGESTS, changed, list_files, told
from motionese.experiment.environment import environment
from motionese.experiment.presets import differences
from motionese.experiment.run import Run
from motionese.experiment.shard import Shard
from motionese.experiment.study import Study
from motionese.files import write_whole

FORMAT, VERSION = "motionese-run", 5
SETTINGS, ENVIRONMENT = "settings.json", "environment.json"
LOCK, HOLDER, SHARD_LOCK = ".lock", ".lock-holder", ".lock-shard-"
SHARDS_WAIT_S = 60
"""How long a shard waits for others that begin at the same time."""
REPORT = "report.html"

Facts = dict[str, Any]


@dataclass(frozen=True)
class RunFolder:
    """A run folder that this process may write to.

    Attributes:
        changed: What it was made with before and is not now, each as 'name: was → now'.
        shown: A digest of the recorded demonstrations of all its runs; empty if scripted.
    """

    path: Path
    changed: tuple[str, ...] = ()
    shown: str = ""

    def run(self, condition: Condition, seed: int) -> Run:
        """Return the run of a condition and a seed."""
        return Run(condition, seed, self.path / condition.folder / f"seed-{seed}", self.shown)


class Opening(NamedTuple):
    """A run folder that is to be made, or gone on with.

    Attributes:
        path: The folder; it may be missing or empty.
        settings: The settings of all its runs.
        preset: What the settings were made from, for the record.
        shown: A digest of the recorded demonstrations of all its runs; empty if scripted.
    """

    path: Path
    settings: Study
    preset: str
    shown: str = ""


@contextmanager
def open_run_folder(
    path: Path, settings: Study, preset: str, shown: str = ""
) -> Iterator[RunFolder]:
    """Make a run folder, or go on with one that has the same settings; others are kept out.

    Raises:
        RunFolderError: It is in use, not ours, of other settings, or cannot be written to.
    """
    with open_run_folders([Opening(path, settings, preset, shown)]) as (folder,):
        yield folder


@contextmanager
def open_run_folders(
    openings: Sequence[Opening], shard: Shard | None = None
) -> Iterator[list[RunFolder]]:
    """Make several run folders, or go on with them; all are checked before one is written to.

    With a shard, others of as many may be open in other processes.

    Raises:
        RunFolderError: One is in use, not ours, of other settings, or cannot be written to.
    """
    for each in openings:
        if each.path.exists():
            _check_ours(each.path)
            _check_same(each)
    with ExitStack() as locks, ExitStack() as whole:
        for each in openings:
            whole.enter_context(_alone(each.path, wait_s=SHARDS_WAIT_S if shard else 0))
            _check_shards(each.path, shard)
        folders = [_begun(each, alone=shard is None) for each in openings]
        if shard:
            for each in openings:
                locks.enter_context(_locked(each.path / _shard_lock(shard), each.path))
            whole.close()
        yield folders


def check_around(path: Path, names: Sequence[str]) -> None:
    """Check a folder that run folders of these names are to lie in.

    Raises:
        RunFolderError: It is a file, a run folder itself, or holds other things alone.
    """
    if not path.exists():
        return
    within = _names_in(path)
    if SETTINGS in within:
        raise RunFolderError(
            f"{path} is a run folder itself; run folders of several presets need one around them, "
            "choose another"
        )
    if within and not run_folders_in(path) and not set(within) & set(names):
        raise RunFolderError(f"{path} is not empty and no run folder lies in it; choose another")


def run_folders_in(path: Path) -> list[Path]:
    """Return the run folders that lie in a folder, by their names."""
    return sorted(settings.parent for settings in path.glob(f"*/{SETTINGS}"))


def _begun(opening: Opening, *, alone: bool) -> RunFolder:
    """Write what stands beside the runs, or check that it is the same."""
    path, settings, preset, shown = opening
    try:
        # Another process may have written them since they were checked without the lock.
        _check_same(opening)
        if alone:
            # What a killed process had not finished writing.
            for part in path.rglob(".*.part"):
                part.unlink()
        if not (path / SETTINGS).exists():
            now = settings.model_dump(mode="json")
            facts = {"format": FORMAT, "version": VERSION, "preset": preset, "settings": now}
            facts |= {"demonstrations": shown} if shown else {}
            write_whole(path / SETTINGS, json.dumps(facts, indent=1))
        now_other = _record_environment(path)
        list_files(path, [SETTINGS, ENVIRONMENT])
        return RunFolder(path, now_other, shown)
    except OSError as error:
        raise RunFolderError(f"{path} cannot be written to: {error.strerror}") from error


def _check_same(opening: Opening) -> None:
    """Refuse a folder whose runs have other settings, or were shown something else."""
    path, settings, _, shown = opening
    if not (path / SETTINGS).exists():
        return
    if changes := differences(run_settings(path), settings.model_dump(mode="json")):
        raise RunFolderError(
            f"{path} holds runs of other settings ({'; '.join(changes)}); choose another --out"
        )
    if (before := run_demonstrations(path)) != shown:
        raise RunFolderError(
            f"{path} holds runs that were shown other demonstrations "
            f"({before or 'scripted'} → {shown or 'scripted'}); choose another --out"
        )


def run_settings(path: Path) -> Facts:
    """Return the settings of a run folder; `RunFolderError` if it is none."""
    if not path.is_dir():
        what = "it is a file" if path.exists() else "there is no such folder"
        raise RunFolderError(f"{path} is no run folder: {what}")
    if not (path / SETTINGS).is_file():
        raise RunFolderError(f"{path} is no run folder: it has no {SETTINGS}")
    _check_unchanged(path)
    facts = _facts(path / SETTINGS)
    if facts.get("format") != FORMAT:
        raise RunFolderError(f"{path / SETTINGS} was not written by motionese")
    if facts.get("version") != VERSION:
        raise RunFolderError(
            f"{path}: run folder of format {facts.get('version')}, this version of motionese "
            f"reads {VERSION}; read it with the version that wrote it, or run it again"
        )
    if not isinstance(facts.get("settings"), dict):
        raise RunFolderError(f"{path / SETTINGS} holds no settings; it was changed by hand")
    return dict(facts["settings"])


def _check_unchanged(path: Path) -> None:
    """Refuse a folder whose settings, or what they were run with, are not what was written."""
    again = "remove it, and the same `motionese reproduce` command writes it again"
    try:
        found = [file for file in changed(path) if file.name in (SETTINGS, ENVIRONMENT)]
    except StorageError as error:
        raise RunFolderError(f"{error}: {again}") from error
    if found and found[0].exists():
        raise RunFolderError(f"{told(found[0])}: {again}")


def run_demonstrations(path: Path) -> str:
    """Return the digest of the recorded demonstrations of a run folder; empty if scripted."""
    return str(_facts(path / SETTINGS).get("demonstrations", ""))


def _facts(file: Path) -> Facts:
    try:
        facts = json.loads(file.read_text())
    except (OSError, ValueError, RecursionError) as error:
        raise RunFolderError(f"{file} cannot be read: {error}") from error
    return facts if isinstance(facts, dict) else {}


def _check_ours(path: Path) -> None:
    names = _names_in(path)
    # A process may have been killed before it wrote the settings.
    foreign = [n for n in names if not n.startswith(LOCK) and not n.endswith(".part")]
    if not {SETTINGS, DIGESTS} & set(names) and foreign:
        raise RunFolderError(
            f"{path} is not empty and no run folder (it has no {SETTINGS}); choose another"
        )


def _names_in(path: Path) -> list[str]:
    if not path.is_dir():
        raise RunFolderError(f"{path} is a file; a run folder must be a folder, choose another")
    try:
        return [each.name for each in path.iterdir()]
    except OSError as error:
        raise RunFolderError(f"{path} cannot be read: {error.strerror}") from error


@contextmanager
def _alone(path: Path, wait_s: float) -> Iterator[None]:
    """Hold a folder's lock, and tell others whose it is."""
    holder = path / HOLDER
    with _locked(path / LOCK, path, wait_s):
        try:
            holder.write_text(str(os.getpid()))
        except OSError as error:
            raise RunFolderError(f"{path} cannot be written to: {error.strerror}") from error
        try:
            yield
        finally:
            holder.unlink(missing_ok=True)


@contextmanager
def _locked(file: Path, path: Path, wait_s: float = 0) -> Iterator[None]:
    """Hold a lock of a folder, which is made if need be."""
    lock = FileLock(file, timeout=wait_s)
    try:
        path.mkdir(parents=True, exist_ok=True)
        lock.acquire()
    except Timeout as error:
        raise RunFolderError(
            f"{path} is in use by another process{_process(path / HOLDER)}; "
            "wait until it has ended, or choose another --out"
        ) from error
    except OSError as error:
        raise RunFolderError(f"{path} cannot be written to: {error.strerror}") from error
    try:
        yield
    finally:
        lock.release()


def _check_shards(path: Path, shard: Shard | None) -> None:
    """Refuse a folder of which another process does the same runs as a shard, or all (None)."""
    for file in path.glob(_shard_lock("*")):
        number, count = map(int, file.name.removeprefix(SHARD_LOCK).split("-"))
        if shard and shard.parts == count and shard.number != number:
            continue
        with suppress(Timeout), FileLock(file, blocking=False):
            file.unlink()
        if file.exists():
            raise RunFolderError(
                f"{path}: shard {number}/{count} is under way in another process, and would do "
                f"some of the runs of {f'shard {shard}' if shard else 'this command'} too; wait "
                "until it has ended, or use the same number of shards"
            )


def _shard_lock(shard: Shard | str) -> str:
    return f"{SHARD_LOCK}{str(shard).replace('/', '-')}"


def _process(holder: Path) -> str:
    try:
        return f" (number {holder.read_text()})"
    except OSError:
        return ""


def _record_environment(path: Path) -> tuple[str, ...]:
    """Write what the folder is made with; changes since the beginning are added, never replaced."""
    now, file = environment(), path / ENVIRONMENT
    facts = _facts(file) if file.is_file() else now
    changed = tuple(differences({name: facts.get(name) for name in now}, now))
    told = list(facts.get("changed", ()))
    added = [change for change in changed if change not in told]
    if added:
        facts["changed"] = told + added
    if added or not file.is_file():
        write_whole(file, json.dumps(facts, indent=1))
    return changed
