"""What a teaching session begins from: a robot that has babbled, or one of a run folder."""

from dataclasses import dataclass
from pathlib import Path

from motionese.errors import RunFolderError
from motionese.experiment import Learner, Scene, Settings, condition, read_settings
from motionese.experiment.checkpoint import latest_checkpoint
from motionese.experiment.reading import checked
from motionese.experiment.run import Run, born, newborn
from motionese.experiment.run_folder import SETTINGS, run_demonstrations, run_settings

BABBLING, FRESH = "babbling", "fresh"
GROWING = condition("TD/MD")
"""The condition of a robot that begins with IO and Cf, and opens Cs when it is told to."""


@dataclass(frozen=True)
class Beginning:
    """A robot, and what it is made with.

    Attributes:
        name: What it began from, for people.
        settings: All settings.
        seed: What everything random depends on.
        learner: What it is.
    """

    name: str
    settings: Settings
    seed: int
    learner: Learner


def begun_with(name: str, scene: Scene) -> Learner:
    """Return a robot that has babbled, or one that has done nothing yet."""
    return born(GROWING, scene) if name == BABBLING else Learner(newborn(GROWING, scene))


def begun_by_babbling() -> tuple[Settings, int]:
    """Return the settings and the seed of a robot that begins with nothing but babbling."""
    return read_settings(), 0


def begun_in(path: Path) -> Beginning:
    """Return the robot of a run folder, as its last whole loop left it.

    Args:
        path: A run folder, or one run in it: FOLDER/CONDITION/seed-SEED or FOLDER/CONDITION/SEED,
            the condition written as 'TD-MD' or 'TD/MD'. Of a whole folder, the run that was
            written last.

    Raises:
        RunFolderError: No run folder, or no such run in it.
        SettingError: Settings that this version does not know.
        StorageError: A checkpoint that cannot be read.
    """
    folder = _folder_of(path)
    settings = checked(run_settings(folder))
    runs = _runs(folder)
    asked = str(path.absolute().relative_to(folder.absolute())).strip(".")
    if asked:
        wanted = asked.replace("seed-", "").replace("/", "-").casefold()
        runs = [r for r in runs if f"{r.condition.folder}-{r.seed}".casefold().startswith(wanted)]
    if not runs:
        raise RunFolderError(f"{path}: there is no run of this name with a whole loop")
    run = max(runs, key=lambda r: max(p.stat().st_mtime for p in r.folder.glob("loop-*")))
    checkpoint = latest_checkpoint(run.folder, run.origin(settings))
    assert checkpoint is not None, "runs without a checkpoint were left out"
    name = f"{run.name}, loop {checkpoint.loop}"
    return Beginning(name, settings, run.seed, checkpoint.learner)


def _folder_of(path: Path) -> Path:
    """Return the run folder that a path lies in; the path itself where none is found."""
    return next((p for p in (path, *path.absolute().parents[:3]) if (p / SETTINGS).is_file()), path)


def _runs(folder: Path) -> list[Run]:
    """Return the runs that have finished a loop."""
    shown = run_demonstrations(folder)
    return [
        Run(condition(place.parent.name.replace("-", "/")), int(place.name[5:]), place, shown)
        for place in sorted(folder.glob("T*D-M*D/seed-*"))
        if place.name[5:].isdigit() and any(place.glob("loop-*.safetensors"))
    ]
