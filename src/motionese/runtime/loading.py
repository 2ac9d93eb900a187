"""A model read from its file without the packages that it was trained with.

The file is in the safetensors format, read by hand: the header's length (8 bytes, little-endian),
the header (JSON: for every tensor its type, shape and place), and the tensors' bytes, row by row,
little-endian, without a gap.
"""

import json
import math
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy import ndarray

from motionese.arguments import refusing
from motionese.errors import CHECKPOINT_BEFORE, NO_MOTION, StorageError
from motionese.runtime.model import RuntimeModel

FORMAT, VERSION = "motionese-mtrnn", 1
FLOATS = {"F64": "<f8", "F32": "<f4", "F16": "<f2"}
"""The format's names of the types that models are written in; tensors of others are passed over."""
BROKEN = (KeyError, TypeError, ValueError, AttributeError, IndexError, RecursionError)


@refusing(StorageError)
def load(path: str | Path) -> RuntimeModel:
    """Read a model that `motionese.save` wrote.

    Raises:
        StorageError: The file is not there, not ours, cut short, of a newer format, without
            channels or initial states, or holds values that no network can have.
    """
    path = Path(path)
    structure, tensors = _contents(path)
    try:
        return _model(path, structure, tensors)
    except BROKEN as error:
        raise StorageError(f"{path}: its description of the network is incomplete") from error


def _contents(path: Path) -> tuple[dict[str, Any], dict[str, ndarray]]:
    if not path.is_file():
        raise StorageError(f"{path}: no such model file")
    try:
        metadata, tensors = parse(path.read_bytes())
        structure = json.loads(metadata.get("motionese", "null"))
    except (*BROKEN, OSError) as error:
        raise StorageError(f"{path}: not a readable model file, perhaps cut short") from error
    if not isinstance(structure, dict) or structure.get("format") != FORMAT:
        raise StorageError(f"{path}: not a model of motionese")
    if structure.get("version") != VERSION:
        raise StorageError(
            f"{path}: model format {structure.get('version')}, this version reads {VERSION}; "
            "install a newer motionese"
        )
    return structure, tensors


def _model(path: Path, structure: dict[str, Any], tensors: dict[str, ndarray]) -> RuntimeModel:
    sizes = [int(level["size"]) for level in structure["levels"]]
    facts = dict(structure["facts"])
    if len(sizes) < 2 or min(sizes) < 1:
        raise StorageError(f"{path}: no valid network: its levels have {sizes} units")
    if "experiences" in facts and "names" not in facts:
        raise StorageError(f"{path}: {CHECKPOINT_BEFORE}")
    if "initial_states" not in tensors or "names" not in facts:
        raise StorageError(f"{path}: a network without a fit; initial states missing")
    names = [str(name) for name in facts["names"]]
    if not names:
        raise StorageError(f"{path}: {NO_MOTION}")
    units = sum(sizes)
    shapes = {
        "weights": (units, units),
        "bias": (units,),
        "tau": (units,),
        "initial_states": (len(names), units),
    }
    held = {name: _checked(path, name, tensors.get(name), shape) for name, shape in shapes.items()}
    level = np.repeat(np.arange(len(sizes)), sizes)
    wired = np.abs(level[:, None] - level[None, :]) <= 1
    initial = dict(zip(names, held["initial_states"], strict=True))
    told = facts.get("lengths")
    lengths = {} if told is None else dict(zip(names, map(int, told), strict=True))
    return RuntimeModel(
        weights=_fixed(held["weights"] * wired),
        bias=_fixed(held["bias"]),
        tau=_fixed(held["tau"]),
        rate_hz=_rate(path, facts.get("rate_hz")),
        initial_states=MappingProxyType(initial),
        lengths=MappingProxyType(lengths),
        senses_first={"sensed": True, "zero": False}[structure["initial_io"]],
        **_channels(path, structure["channels"], sizes[0]),
    )


def _checked(path: Path, name: str, value: ndarray | None, shape: tuple[int, ...]) -> ndarray:
    if value is None or value.shape != shape:
        got = "nothing" if value is None else f"shape {value.shape}"
        raise StorageError(f"{path}: {name} must have shape {shape}, got {got}")
    with np.errstate(over="ignore"):
        single = value.astype(np.float32)
    if not np.isfinite(single).all():
        raise StorageError(f"{path}: {name} holds values that are not finite")
    if name == "tau" and single.min() < 1:
        raise StorageError(f"{path}: tau must be ≥ 1 step, got {float(single.min()):g}")
    return single


def _fixed(value: ndarray) -> ndarray:
    value = np.ascontiguousarray(value)
    value.flags.writeable = False
    return value


def _rate(path: Path, rate_hz: Any) -> float | None:
    if rate_hz is None:
        return None
    if not 0 < (rate := float(rate_hz)) < np.inf:
        raise StorageError(f"{path}: its rate must be finite and > 0 Hz, got {rate_hz}")
    return rate


def _channels(path: Path, channels: Any, width: int) -> dict[str, Any]:
    """Return the fields of a model that tell its channels."""
    if channels is None:
        raise StorageError(f"{path}: the network carries no channels; train it on motions first")
    names = tuple(str(channel["name"]) for channel in channels)
    low, high = (np.array([float(c[end]) for c in channels]) for end in ("low", "high"))
    if len(names) != width or len(set(names)) < width:
        raise StorageError(
            f"{path}: no valid network: {width} IO units need as many channels of different names, "
            f"got {', '.join(names)}"
        )
    wrong = np.flatnonzero(~(np.isfinite(low) & np.isfinite(high) & (low < high)))
    if len(wrong):
        raise StorageError(
            f"{path}: no valid network: channel '{names[wrong[0]]}': its range must be finite with "
            f"low < high, got {low[wrong[0]]:g} to {high[wrong[0]]:g}"
        )
    units = tuple(str(channel["unit"]) for channel in channels)
    two = np.array([channel.get("binary") or (np.nan, np.nan) for channel in channels], np.float64)
    held = {"low": low, "high": high, "binary": two}
    return {"channels": names, "units": units, **{name: _fixed(v) for name, v in held.items()}}


def parse(content: bytes) -> tuple[dict[str, str], dict[str, ndarray]]:
    """Return the metadata and the floating-point tensors of a file's content.

    Raises:
        ValueError, KeyError, TypeError, RecursionError: The content is cut short or no safetensors.
    """
    size = int.from_bytes(content[:8], "little")
    if len(content) < 8 or size > len(content) - 8:
        raise ValueError("the header is cut short")
    header = json.loads(content[8 : 8 + size])
    metadata = dict(header.pop("__metadata__", {}))
    held = memoryview(content)[8 + size :]
    tensors = {name: _tensor(entry, held) for name, entry in header.items()}
    if max((entry["data_offsets"][1] for entry in header.values()), default=0) != len(held):
        raise ValueError("the tensors do not fill the file")
    return metadata, {name: value for name, value in tensors.items() if value is not None}


def _tensor(entry: dict[str, Any], held: memoryview) -> ndarray | None:
    begin, end = entry["data_offsets"]
    if not 0 <= begin <= end <= len(held):
        raise ValueError("a tensor lies outside the file")
    if entry["dtype"] not in FLOATS:
        return None
    dtype, shape = np.dtype(FLOATS[entry["dtype"]]), tuple(entry["shape"])
    if math.prod(shape) * dtype.itemsize != end - begin:
        raise ValueError("a tensor's shape does not fit its bytes")
    return np.frombuffer(held[begin:end], dtype).reshape(shape)
