"""A network on disk: one safetensors file, its structure as JSON in the file's metadata."""

import json
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import numpy as np
import safetensors
import safetensors.numpy
from numpy import ndarray
from pydantic import BaseModel, Field

from motionese.channels import Channel, Channels
from motionese.errors import MotioneseError, StorageError
from motionese.files import write_whole
from motionese.network.mtrnn import MTRNN, InitialIO, shapes

FORMAT, VERSION = "motionese-mtrnn", 1


class _Level(BaseModel):
    """A level; its τ stands in the file too, for people: the array counts."""

    size: Annotated[int, Field(ge=1)]
    name: str


class _Description(BaseModel):
    """What a model's file tells beside its arrays."""

    levels: tuple[_Level, ...]
    channels: tuple[Channel, ...] | None
    learned_bias: bool
    initial_io: InitialIO
    facts: Mapping[str, Any]


def write_network(
    path: Path, network: MTRNN, arrays: Mapping[str, ndarray], facts: Mapping[str, Any]
) -> None:
    """Write a network together with further arrays and JSON-able facts, whole or not at all."""
    structure = {
        "format": FORMAT,
        "version": VERSION,
        "levels": [{"name": v.name, "size": v.size, "tau": v.tau} for v in network.levels],
        "channels": None if network.channels is None else [vars(c) for c in network.channels],
        "learned_bias": network.learned_bias,
        "initial_io": network.initial_io,
        "facts": dict(facts),
    }
    held = {**network.arrays, **arrays}
    tensors = {name: np.ascontiguousarray(value) for name, value in held.items()}
    write_whole(path, safetensors.numpy.save(tensors, {"motionese": json.dumps(structure)}))


def read_network(path: Path) -> tuple[MTRNN, dict[str, ndarray], dict[str, Any]]:
    """Read what `write_network` wrote.

    Returns:
        The network, the further arrays, the facts.

    Raises:
        StorageError: The file is not there, not ours, cut short, of a newer format, or holds
            shapes, time constants or values that no network can have.
    """
    structure, tensors = _contents(path)
    try:
        told = _Description(**structure)
        sizes = tuple(level.size for level in told.levels)
        own: dict[str, Any] = {}
        for name, shape in shapes(sizes, "variance_weights" in tensors).items():
            own[name] = _checked(path, name, tensors.pop(name, None), shape)
        network = MTRNN(
            **own,
            names=tuple(level.name for level in told.levels),
            sizes=sizes,
            learned_bias=told.learned_bias,
            initial_io=told.initial_io,
            channels=None if told.channels is None else Channels(told.channels),
        )
    except StorageError:
        raise
    except MotioneseError as error:
        raise StorageError(f"{path}: no valid network: {error}") from error
    except (TypeError, ValueError) as error:
        raise StorageError(f"{path}: its description of the network is incomplete") from error
    return network, tensors, dict(told.facts)


def _contents(path: Path) -> tuple[dict[str, Any], dict[str, ndarray]]:
    if not path.is_file():
        raise StorageError(f"{path}: no such model file")
    try:
        with safetensors.safe_open(path, framework="numpy") as file:
            metadata = file.metadata() or {}
            tensors = {name: file.get_tensor(name) for name in file.keys()}  # noqa: SIM118
        structure = json.loads(metadata.get("motionese", "null"))
    except (safetensors.SafetensorError, ValueError, RecursionError, OSError) as error:
        raise StorageError(f"{path}: not a readable model file, perhaps cut short") from error
    if not isinstance(structure, dict) or structure.get("format") != FORMAT:
        raise StorageError(f"{path}: not a model of motionese")
    if structure.get("version") != VERSION:
        raise StorageError(
            f"{path}: model format {structure.get('version')}, this version reads {VERSION}; "
            "install a newer motionese"
        )
    return structure, tensors


def _checked(path: Path, name: str, value: ndarray | None, shape: tuple[int, ...]) -> ndarray:
    if value is None or value.shape != shape:
        got = "nothing" if value is None else f"shape {value.shape}"
        raise StorageError(f"{path}: {name} must have shape {shape}, got {got}")
    if not np.isfinite(value).all():
        raise StorageError(f"{path}: {name} holds values that are not finite")
    if name == "tau" and value.min() < 1:
        raise StorageError(f"{path}: tau must be ≥ 1 step, got {float(value.min()):g}")
    if not math.prod(shape):
        raise StorageError(f"{path}: {name} is empty")
    return value
