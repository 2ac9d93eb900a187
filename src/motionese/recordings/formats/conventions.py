"""What holds in files of every format: their order, what is no channel, times, and their faults."""

import re
import zipfile
import zlib
from importlib import import_module
from tokenize import TokenError
from typing import Any

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import needs
from motionese.recordings.grid import JITTER

WIDEST = 512
"""Columns of the widest array of channels: wider are pictures, embeddings and clouds of points."""
UNREADABLE = (
    *(OSError, EOFError, MemoryError, zipfile.BadZipFile, zlib.error),
    # Headers are parsed as Python literals, archives as whatever their entries say.
    *(ValueError, SyntaxError, TokenError, TypeError, KeyError, AttributeError, OverflowError),
    *(NotImplementedError, RuntimeError),
)
"""What NumPy raises where a file is none of its own."""
_BOOKKEEPING = re.compile(
    r"(^|[./])(header|stamp|timestamp|seq|sec|secs|nsec|nsecs|nanosec|nanoseconds)([./]|$)"
)


def imported(module: str, extra: str, what: str) -> Any:
    """Return a module of an extra; `MissingPackageError` that says how to install it."""
    try:
        return import_module(module)
    except ImportError as error:
        raise needs(module.partition(".")[0], extra, what) from error


def strings(told: Any, width: int | None = None) -> tuple[str, ...] | None:
    """Return a list of (so many) strings; None for anything else."""
    if isinstance(told, list) and all(isinstance(t, str) for t in told):
        return tuple(told) if width in {None, len(told)} else None
    return None


def numbered(label: str, width: int) -> tuple[str, ...]:
    """Return names of columns without names: LABEL_0, LABEL_1, …, plainly LABEL for one."""
    return (label,) if width == 1 else tuple(f"{label}_{i}" for i in range(width))


def natural(name: str) -> tuple[tuple[bool, int, str], ...]:
    """Return the key that sorts names with their numbers as numbers: demo_2 before demo_10."""
    parts = re.split(r"([0-9]+)", name)
    return tuple((not p.isdecimal(), int(p) if p.isdecimal() else 0, p) for p in parts)


def is_bookkeeping(path: str) -> bool:
    """Tell whether a path such as "header.stamp.secs" leads to a header, stamp or row number."""
    return _BOOKKEEPING.search(path) is not None


def times_unless_even(
    times: Float[ndarray, " T"], rate_hz: float | None
) -> Float[ndarray, " T"] | None:
    """Return `times` [s] counted from the first, or None where they only repeat the rate."""
    since_first: Float[ndarray, " T"] = times - times[:1]
    if rate_hz is not None:
        off = since_first * rate_hz - np.arange(len(times))
        if np.all(np.abs(off) <= JITTER):
            return None
    return since_first


def why(error: BaseException) -> str:
    """Return an error's own words on one line."""
    return " ".join(str(error).split()) or type(error).__name__
