"""What is to be performed: the runs of every preset that is asked for, checked before anything."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from motionese.caregiver import Recorded, read_recorded
from motionese.errors import MotioneseError, SettingError
from motionese.experiment import Condition, Study, read_settings
from motionese.experiment.many_runs import Job
from motionese.experiment.run_folder import Opening, RunFolder
from motionese.imitation import Scene, newborn
from motionese.interfaces.commands.choices import read_conditions

SCRIPTED = "scripted"


@dataclass(frozen=True)
class Series:
    """The runs of one preset.

    Attributes:
        path: Their run folder.
        label: What tells its runs from those of other presets; empty where there are none.
        shown: Recorded demonstrations; None with the scripted caregiver.
    """

    preset: str
    settings: Study
    conditions: Sequence[Condition]
    path: Path
    label: str
    shown: Recorded | None

    @property
    def opening(self) -> Opening:
        """How its run folder is opened."""
        digest = self.shown.digest if self.shown else ""
        return Opening(self.path, self.settings, self.preset, digest)

    def jobs(self, folder: RunFolder, seeds: Sequence[int]) -> list[Job]:
        """Return its runs with these seeds."""
        recordings = self.shown.recordings if self.shown else None
        return [
            Job(folder.run(condition, seed), self.settings, recordings, self.label)
            for seed in seeds
            for condition in self.conditions
        ]


def read_series(
    presets: Sequence[str],
    out: Path | None,
    *,
    conditions: Iterable[str],
    overrides: Iterable[str],
    caregiver: str,
    quick: bool,
) -> tuple[Path, list[Series]]:
    """Return the folder of everything, and a series for each preset.

    One preset has this folder as its run folder; several have a run folder each in it.

    Raises:
        MotioneseError: Something does not exist, or does not fit one of the presets.
    """
    names = [Path(preset).stem for preset in presets]
    if doubled := sorted({name for name in names if names.count(name) > 1}):
        raise SettingError(
            f"--preset: several are called {', '.join(doubled)}; each needs a name of its own, "
            "which becomes that of its run folder"
        )
    root = out or Path("runs") / ("-".join(names) + ("-quick" if quick else ""))
    chosen, single, series = list(conditions), list(overrides), []
    for preset, name in zip(presets, names, strict=True):
        label = name if len(names) > 1 else ""
        with _naming(label):
            settings = read_settings(preset, single, quick=quick)
            scene = Scene(settings, seed=0)
            newborn(scene, len(settings.network.levels))
            these, shown = read_conditions(chosen, settings), _recorded(caregiver, scene)
        series.append(Series(preset, settings, these, root / label, label, shown))
    return root, series


@contextmanager
def _naming(label: str) -> Iterator[None]:
    """Say of which of several presets it is that something does not fit."""
    try:
        yield
    except MotioneseError as error:
        if not label:
            raise
        raise type(error)(f"preset {label}: {error}") from error


def _recorded(caregiver: str, scene: Scene) -> Recorded | None:
    """Return the demonstrations of 'recordings:PATH', or None for 'scripted'."""
    kind, _, path = caregiver.partition(":")
    if caregiver == SCRIPTED:
        return None
    if kind != "recordings" or not path:
        raise SettingError(f"--caregiver is {SCRIPTED} or recordings:FOLDER, got '{caregiver}'")
    return read_recorded(Path(path), scene.task, scene.settings.caregiver, scene.body)
