"""The robot of a run folder, as its last whole loop left it: to be taught on by a person."""

from dataclasses import dataclass
from pathlib import Path

from motionese.errors import RunFolderError
from motionese.experiment.checkpoint import checkpoint_path, read_checkpoint
from motionese.experiment.presets import study_of
from motionese.experiment.run import runs_in
from motionese.experiment.run_folder import SETTINGS, run_demonstrations, run_settings
from motionese.experiment.study import Study
from motionese.imitation import Learner


@dataclass(frozen=True)
class TrainedRobot:
    """What a robot has become, and the settings and seed of its run."""

    settings: Study
    seed: int
    learner: Learner


def robot_of(path: Path) -> TrainedRobot:
    """Return the robot of a run, as its last whole loop left it.

    Args:
        path: A run folder, or one run in it: FOLDER/CONDITION/seed-SEED or FOLDER/CONDITION/SEED,
            the condition written as 'TD-MD' or 'TD/MD'. Of a whole folder, the run that was
            written last.

    Raises:
        RunFolderError: No run folder, no such run in it, or a file of it has changed.
        SettingError: Settings that this version does not know.
        StorageError: A checkpoint that cannot be read.
    """
    whole = path.resolve()
    folder = next((p for p in (whole, *whole.parents[:3]) if (p / SETTINGS).is_file()), path)
    settings = study_of(run_settings(folder))
    runs = [r for r in runs_in(folder, settings, run_demonstrations(folder)) if r.loops_done()]
    asked = str(whole.relative_to(folder.resolve())).strip(".")
    if asked:
        wanted = asked.replace("seed-", "").replace("/", "-").casefold()
        runs = [r for r in runs if f"{r.condition.folder}-{r.seed}".casefold().startswith(wanted)]
    if not runs:
        raise RunFolderError(f"{path}: there is no run of this name with a whole loop")
    last = {run: checkpoint_path(run.folder, run.loops_done()) for run in runs}
    run = max(runs, key=lambda r: last[r].stat().st_mtime)
    run.check()
    checkpoint = read_checkpoint(last[run], run.origin(settings))
    return TrainedRobot(settings, run.seed, checkpoint.learner)
