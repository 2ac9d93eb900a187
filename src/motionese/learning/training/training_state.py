"""The state of a training: all that its next epoch depends on, in memory and in a checkpoint."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Float
from numpy import ndarray
from safetensors import SafetensorError, safe_open
from safetensors.numpy import save as as_safetensors

from motionese.errors import StorageError
from motionese.files import write_whole
from motionese.learning.training.updates import Iterate

FORMAT, VERSION = "motionese-training", "4"
SERIES = ("losses", "validation_losses")


@dataclass(frozen=True)
class TrainingState:
    """Where a training stands.

    Attributes:
        latest: Parameters, the update rule's memory, updates done.
        best: The one that was best for the held-out motions so far.
        held_out: Initial states of the held-out motions, as found last. [H, N]
        losses: One an update. [U]
        validation_losses: One a chunk of epochs. [V]
    """

    latest: Iterate
    best: Iterate
    held_out: Float[ndarray, "H N"]
    losses: Float[ndarray, " U"]
    validation_losses: Float[ndarray, " V"]

    def write(self, path: Path, origin: Mapping[str, str], epochs: int) -> None:
        """Write a checkpoint, whole or not at all.

        Args:
            path: The file.
            origin: What it belongs to.
            epochs: How many whole ones are done.
        """
        arrays = {name: getattr(self, name) for name in (*SERIES, "held_out")}
        for name in ("latest", "best"):
            for i, leaf in enumerate(jax.tree.leaves(getattr(self, name))):
                arrays[f"{name}.{i}"] = np.asarray(leaf)
        facts = {"format": FORMAT, "version": VERSION, "epochs": str(epochs), **origin}
        write_whole(path, as_safetensors(arrays, facts))

    def resumed(self, path: Path, origin: Mapping[str, str]) -> "TrainingState":
        """Return the state that a checkpoint holds, this one being where it began.

        Raises:
            StorageError: The file is no checkpoint of this version, is cut short, or belongs to
                another network, other motions, or other settings.
        """
        facts, arrays = _contents(path)
        for part, digest in origin.items():
            if facts.get(part) != digest:
                raise StorageError(
                    f"{path}: this training was begun with other {part}; "
                    "go on with the same, or remove the file to begin afresh"
                )
        for name in SERIES:
            _check(path, arrays, name, (len(arrays.get(name, ())),))
        _check(path, arrays, "held_out", self.held_out.shape)
        latest = _filled(path, arrays, "latest", self.latest)
        best = _filled(path, arrays, "best", self.best)
        return TrainingState(latest, best, arrays["held_out"], *(arrays[name] for name in SERIES))


def checkpoint_facts(path: Path) -> dict[str, str]:
    """Return what a checkpoint belongs to, and its `epochs`; `StorageError` if it is none."""
    return _contents(path)[0]


def _contents(path: Path) -> tuple[dict[str, str], dict[str, ndarray]]:
    try:
        with safe_open(path, framework="numpy") as file:
            facts = file.metadata() or {}
            arrays = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
    except (SafetensorError, OSError) as error:
        raise StorageError(f"{path}: not a readable checkpoint, perhaps cut short") from error
    if (facts.get("format"), facts.get("version")) != (FORMAT, VERSION):
        raise StorageError(f"{path}: not a checkpoint of training that this version reads")
    return facts, arrays


def _filled(path: Path, arrays: Mapping[str, ndarray], name: str, like: Iterate) -> Iterate:
    leaves, structure = jax.tree.flatten(like)
    for i, leaf in enumerate(leaves):
        _check(path, arrays, f"{name}.{i}", leaf.shape)
    filled = [jnp.asarray(arrays[f"{name}.{i}"], leaf.dtype) for i, leaf in enumerate(leaves)]
    iterate: Iterate = jax.tree.unflatten(structure, filled)
    return iterate


def _check(path: Path, arrays: Mapping[str, ndarray], name: str, shape: tuple[int, ...]) -> None:
    if name not in arrays or arrays[name].shape != shape:
        raise StorageError(f"{path}: not a whole checkpoint: {name} is missing or misshapen")
