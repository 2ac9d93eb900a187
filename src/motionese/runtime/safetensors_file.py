"""The safetensors format, read by hand: a robot's computer needs no package for it.

A file is the header's length (8 bytes, little-endian), the header (JSON: for every tensor its type,
shape and place), and the tensors' bytes, row by row, little-endian, without a gap.
"""

import json
import math
from typing import Any

import numpy as np
from numpy import ndarray

FLOATS = {"F64": "<f8", "F32": "<f4", "F16": "<f2"}
"""The format's names of the types that models are written in; tensors of others are passed over."""


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
