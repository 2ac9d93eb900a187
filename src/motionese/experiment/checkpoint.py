"""A checkpoint per loop: the learner and what the loop measured, in one file."""

from dataclasses import dataclass
from pathlib import Path

from motionese.errors import StorageError
from motionese.experiment.digests import listed_and_there
from motionese.imitation import Learner, Row, read_learner, write_learner


@dataclass(frozen=True)
class Checkpoint:
    """A run after a whole loop.

    Attributes:
        origin: Which run of which settings it belongs to.
        rows: What was measured in this loop, a row per motion.
        development: What the network was after it.
        failure: Why the run must end here; empty if it goes on.
        seconds: How long the run has taken so far [s].
    """

    origin: str
    loop: int
    learner: Learner
    rows: list[Row]
    development: Row
    failure: str
    seconds: float


def checkpoint_path(folder: Path, loop: int) -> Path:
    """Return where a loop's checkpoint lies in a run's folder."""
    return folder / f"loop-{loop:02d}.safetensors"


def write_checkpoint(folder: Path, checkpoint: Checkpoint, rate_hz: float) -> None:
    """Write a checkpoint, whole or not at all."""
    facts = {name: value for name, value in vars(checkpoint).items() if name != "learner"}
    write_learner(checkpoint_path(folder, checkpoint.loop), checkpoint.learner, rate_hz, facts)


def read_checkpoint(path: Path, origin: str) -> Checkpoint:
    """Read a checkpoint of a run.

    Raises:
        StorageError: It is cut short, not one of ours, or of another loop, run or other settings.
    """
    learner, facts = read_learner(path)
    try:
        checkpoint = Checkpoint(learner=learner, **facts)
    except TypeError as error:
        raise StorageError(f"{path}: a model, but not a checkpoint of an experiment") from error
    if checkpoint.origin != origin or path.name != checkpoint_path(path, checkpoint.loop).name:
        raise StorageError(
            f"{path}: a checkpoint of loop {checkpoint.loop} of {checkpoint.origin}, "
            f"where one of {origin} should be"
        )
    return checkpoint


def checkpoints_in(folder: Path) -> list[Path]:
    """Return the checkpoints of all whole loops of a run, in order.

    Raises:
        StorageError: The list of the folder's files has changed since it was written.
    """
    return listed_and_there(folder, "loop-*.safetensors")


def read_checkpoints(folder: Path, origin: str) -> list[Checkpoint]:
    """Return what the checkpoints of all whole loops of a run hold, in order.

    Raises:
        StorageError: One is missing before the last, or cannot be read.
    """
    loops = len(checkpoints_in(folder))
    paths = [checkpoint_path(folder, loop) for loop in range(1, loops + 1)]
    missing = [path for path in paths if not path.exists()]
    if missing:
        raise StorageError(f"{missing[0]}: missing, though later loops are there")
    return [read_checkpoint(path, origin) for path in paths]
