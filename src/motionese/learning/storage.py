"""A fit on disk: the network, the initial states it learned, how training ended, and more."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from numpy import ndarray
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from motionese.arguments import refusing
from motionese.errors import CHECKPOINT_BEFORE, StorageError, unknown
from motionese.learning.fit import Fit
from motionese.learning.status import Ending, Status
from motionese.network import MTRNN, read_network, write_network

ARRAYS = (
    "initial_states",
    "losses",
    "validation_losses",
    "teacher_forced_error",
    "closed_loop_error",
    "validation_error",
)
TOLD = ("names", "lengths", "rate_hz", "validation_names")
FURTHER = "further"
"""The fact, and the beginning of the arrays' names, that hold what is written with a fit."""


class _Facts(BaseModel):
    """What a fit tells beside its arrays, as a file holds it."""

    model_config = ConfigDict(frozen=True, extra="ignore")

    names: tuple[str, ...]
    lengths: tuple[Annotated[int, Field(ge=2)], ...]
    rate_hz: Annotated[float, Field(gt=0, allow_inf_nan=False)]
    validation_names: tuple[str, ...]
    status: str
    sentence: str
    further: dict[str, Any] = {}


@refusing(StorageError)
def save(path: str | Path, fit: Fit) -> None:
    """Write a fit to one safetensors file, whole or not at all."""
    write_fit(path, fit, {}, {})


@refusing(StorageError)
def load(path: str | Path) -> Fit:
    """Read what `save` or `write_fit` wrote; `StorageError` if it is not a fit, or cut short."""
    return read_fit(path)[0]


@refusing(StorageError)
def write_fit(
    path: str | Path, fit: Fit, arrays: Mapping[str, ndarray], facts: Mapping[str, Any]
) -> None:
    """Write a fit and what belongs to it to one safetensors file, whole or not at all.

    Whatever reads a fit reads such a file. A fit of no motions can be written: the network of a
    robot that has not learned any yet. Further arrays, and facts as JSON can hold them, have names
    of their own.
    """
    own = {name: getattr(fit, name) for name in TOLD}
    own |= {"status": fit.status.ending.value, "sentence": fit.status.sentence}
    tensors = {name: np.asarray(getattr(fit, name)) for name in ARRAYS}
    tensors |= {f"{FURTHER}.{name}": value for name, value in arrays.items()}
    write_network(Path(path), fit.network, tensors, {**own, FURTHER: dict(facts)} if facts else own)


@refusing(StorageError)
def read_fit(path: str | Path) -> tuple[Fit, dict[str, ndarray], dict[str, Any]]:
    """Return a fit, the further arrays and the further facts, as `write_fit` wrote them.

    Raises:
        StorageError: The file is not a fit, or cut short.
    """
    network, arrays, told = read_network(Path(path))
    if "experiences" in told and "names" not in told:
        raise StorageError(f"{path}: {CHECKPOINT_BEFORE}")
    missing = [name for name in ARRAYS if name not in arrays]
    missing += [n for n, f in _Facts.model_fields.items() if f.is_required() and n not in told]
    missing += ["channels"] if network.channels is None else []
    if missing:
        raise StorageError(f"{path}: a network without a fit; {', '.join(missing)} missing")
    try:
        facts = _Facts(**told)
    except ValidationError as error:
        first = error.errors()[0]
        raise StorageError(f"{path}: its {first['loc'][0]}: {first['msg']}") from error
    endings = [ending.value for ending in Ending]
    if facts.status not in endings:
        raise StorageError(f"{path}: {unknown('status', facts.status, endings)}")
    _check_shapes(Path(path), network, arrays, facts)
    status = Status(Ending(facts.status), facts.sentence)
    held: dict[str, Any] = {name: getattr(facts, name) for name in TOLD}
    held |= {name: arrays[name] for name in ARRAYS}
    prefix = f"{FURTHER}."
    further = {n.removeprefix(prefix): a for n, a in arrays.items() if n.startswith(prefix)}
    return Fit(network=network, status=status, **held), further, facts.further


def _check_shapes(path: Path, network: MTRNN, arrays: Mapping[str, ndarray], facts: _Facts) -> None:
    learned, held_out = len(facts.names), len(facts.validation_names)
    shapes = {
        "initial_states": (learned, network.size),
        "teacher_forced_error": (learned, network.io_size),
        "closed_loop_error": (learned, network.io_size),
        "validation_error": (held_out, network.io_size),
        "lengths": (learned,),
    }
    for name, shape in shapes.items():
        got = np.shape(facts.lengths if name == "lengths" else arrays[name])
        if got != shape:
            raise StorageError(f"{path}: {name} must have shape {shape}, got {got}")
    if not np.isfinite(arrays["initial_states"]).all():
        raise StorageError(f"{path}: initial_states must be finite")
