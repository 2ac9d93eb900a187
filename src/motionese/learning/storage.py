"""A fit on disk: the network, the initial states it learned, and how training ended."""

from pathlib import Path

import numpy as np

from motionese.errors import StorageError, unknown
from motionese.learning.fit import Fit
from motionese.learning.status import Ending, Status
from motionese.network import read_network, write_network

ARRAYS = (
    "initial_states",
    "losses",
    "validation_losses",
    "teacher_forced_error",
    "closed_loop_error",
    "validation_error",
)
FACTS = ("names", "lengths", "rate_hz", "validation_names", "status", "sentence")


def save(path: str | Path, fit: Fit) -> None:
    """Write a fit to one safetensors file, whole or not at all."""
    facts = {
        "names": list(fit.names),
        "lengths": list(fit.lengths),
        "rate_hz": fit.rate_hz,
        "validation_names": list(fit.validation_names),
        "status": fit.status.ending.value,
        "sentence": fit.status.sentence,
    }
    arrays = {name: np.asarray(getattr(fit, name)) for name in ARRAYS}
    write_network(Path(path), fit.network, arrays, facts)


def load(path: str | Path) -> Fit:
    """Read what `save` wrote; `StorageError` if the file is not a fit, or cut short."""
    network, arrays, facts = read_network(Path(path))
    missing = [name for name in ARRAYS if name not in arrays]
    missing += [name for name in FACTS if name not in facts]
    if missing:
        raise StorageError(f"{path}: a network without a fit; {', '.join(missing)} missing")
    endings = [ending.value for ending in Ending]
    if facts["status"] not in endings:
        raise StorageError(f"{path}: {unknown('status', facts['status'], endings)}")
    states = arrays["initial_states"]
    if states.shape != (len(facts["names"]), network.size):
        raise StorageError(
            f"{path}: initial_states must have shape {(len(facts['names']), network.size)}, "
            f"got {states.shape}"
        )
    return Fit(
        network=network,
        names=tuple(facts["names"]),
        lengths=tuple(facts["lengths"]),
        rate_hz=float(facts["rate_hz"]),
        validation_names=tuple(facts["validation_names"]),
        status=Status(Ending(facts["status"]), facts["sentence"]),
        **{name: arrays[name] for name in ARRAYS},
    )
