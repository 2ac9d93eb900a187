"""What is to be performed: the runs of every preset that is asked for, checked before anything."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple

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
    """The runs of one preset, perhaps with other settings.

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


class Asked(NamedTuple):
    """A series as it is asked for: a preset with overrides, and what tells it from others."""

    preset: str
    overrides: Sequence[str]
    label: str


def read_presets(
    presets: Sequence[str], overrides: Sequence[str], out: Path | None, *, quick: bool
) -> tuple[Path, list[Asked]]:
    """Return the folder of everything, and the series of each preset.

    One preset has this folder as its run folder; several have a run folder each in it.

    Raises:
        SettingError: Several presets are called the same.
    """
    names = [Path(preset).stem for preset in presets]
    if doubled := sorted({name for name in names if names.count(name) > 1}):
        raise SettingError(
            f"--preset: several are called {', '.join(doubled)}; each needs a name of its own, "
            "which becomes that of its run folder"
        )
    root = out or Path("runs") / ("-".join(names) + ("-quick" if quick else ""))
    labels = names if len(names) > 1 else [""]
    return root, [Asked(p, overrides, of) for p, of in zip(presets, labels, strict=True)]


def read_series(
    root: Path,
    asked: Sequence[Asked],
    *,
    conditions: Iterable[str],
    quick: bool,
    caregiver: str = SCRIPTED,
    kind: str = "preset",
) -> list[Series]:
    """Return what is asked for, after all of it was checked; `kind` is what labels stand for.

    Raises:
        MotioneseError: Something does not exist, or does not fit one of the series.
    """
    chosen, series = list(conditions), []
    for preset, overrides, label in asked:
        with _naming(label and f"{kind} {label}"):
            settings = read_settings(preset, overrides, quick=quick)
            scene = Scene(settings, seed=0)
            newborn(scene, len(settings.network.levels))
            these, shown = read_conditions(chosen, settings), _recorded(caregiver, scene)
        series.append(Series(preset, settings, these, root / label, label, shown))
    return series


@contextmanager
def _naming(series: str) -> Iterator[None]:
    """Say of which of several series it is that something does not fit."""
    try:
        yield
    except MotioneseError as error:
        if not series:
            raise
        raise type(error)(f"{series}: {error}") from error


def _recorded(caregiver: str, scene: Scene) -> Recorded | None:
    """Return the demonstrations of 'recordings:PATH', or None for 'scripted'."""
    kind, _, path = caregiver.partition(":")
    if caregiver == SCRIPTED:
        return None
    if kind != "recordings" or not path:
        raise SettingError(f"--caregiver is {SCRIPTED} or recordings:FOLDER, got '{caregiver}'")
    return read_recorded(Path(path), scene.task, scene.settings.caregiver, scene.body)
