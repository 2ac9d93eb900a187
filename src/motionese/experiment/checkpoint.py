"""A checkpoint per loop: the learner and what the loop measured, in one file."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from motionese.errors import StorageError
from motionese.experiment.imitation_loop import Row
from motionese.experiment.learner import Experience, Learner
from motionese.network import read_network, write_network


@dataclass(frozen=True)
class Checkpoint:
    """A run after a whole loop.

    Attributes:
        origin: Which run of which settings it belongs to.
        loop: The loop that was finished.
        learner: What the robot has become.
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


def write_checkpoint(folder: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint, whole or not at all."""
    facts = {name: value for name, value in vars(checkpoint).items() if name != "learner"}
    write_learner(checkpoint_path(folder, checkpoint.loop), checkpoint.learner, facts)


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


def write_learner(path: Path, learner: Learner, facts: dict[str, Any]) -> None:
    """Write what a robot has become, and JSON-able facts, whole or not at all."""
    told = {
        **facts,
        "experiences": [{"loop": e.loop, "motion": e.motion} for e in learner.experiences],
    }
    arrays = {}
    for i, experience in enumerate(learner.experiences):
        arrays[f"values.{i}"] = experience.values
        arrays[f"initial_state.{i}"] = np.asarray(experience.initial_state)
    write_network(path, learner.network, arrays, told)


def read_learner(path: Path) -> tuple[Learner, dict[str, Any]]:
    """Read what `write_learner` wrote.

    Raises:
        StorageError: It is cut short, or not one of ours.
    """
    network, arrays, facts = read_network(path)
    try:
        experiences = tuple(
            Experience(
                loop=each["loop"],
                motion=each["motion"],
                values=arrays[f"values.{i}"],
                initial_state=arrays[f"initial_state.{i}"],
            )
            for i, each in enumerate(facts.pop("experiences"))
        )
    except (KeyError, TypeError) as error:
        raise StorageError(f"{path}: a model, but not a checkpoint of an experiment") from error
    for experience in experiences:
        fits = experience.initial_state.shape == (network.size,)
        if not (fits and np.isfinite(experience.initial_state).all()):
            raise StorageError(f"{path}: initial states that do not fit its network")
    return Learner(network, experiences), facts


def latest_checkpoint(folder: Path, origin: str) -> Checkpoint | None:
    """Return the checkpoint of a run's last whole loop, if there is one."""
    paths = folder.glob("loop-*.safetensors")
    latest = max(paths, key=lambda path: int(path.stem.removeprefix("loop-")), default=None)
    return read_checkpoint(latest, origin) if latest else None
