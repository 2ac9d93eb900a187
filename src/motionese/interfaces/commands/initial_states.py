"""Initial states that were recognised, as a file from which motions are generated."""

import json
from collections.abc import Mapping
from pathlib import Path

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import StorageError
from motionese.files import write_whole
from motionese.network import MTRNN

FORMAT, VERSION = "motionese-initial-states", 1
LARGEST = float(np.finfo(np.float32).max)
"""Potentials are single-precision numbers."""
MOST_ROWS = 1_000_000
"""Of one motion: beyond it, no memory holds what a network computes."""


def write_initial_states(
    path: Path, network: MTRNN, states: Mapping[str, Float[ndarray, " N"]], rows: Mapping[str, int]
) -> None:
    """Write the initial states of motions, by name, and how many rows the motions had."""
    content = {
        "format": FORMAT,
        "version": VERSION,
        "units": {level.name: level.size for level in network.levels},
        "motions": {
            name: {"rows": rows[name], "initial_state": [float(u) for u in state]}
            for name, state in states.items()
        },
    }
    try:
        write_whole(path, json.dumps(content, indent=1))
    except OSError as error:
        raise StorageError(f"{path}: cannot be written: {error.strerror}") from error


def read_initial_states(path: Path, network: MTRNN) -> dict[str, tuple[Float[ndarray, " N"], int]]:
    """Read initial states and rows by the motion's name.

    Raises:
        StorageError: No such file, not ours, of a newer format, or of another network.
    """
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise StorageError(f"{path}: there is no such file") from error
    except (OSError, ValueError, RecursionError) as error:
        raise StorageError(f"{path}: not a readable file of initial states") from error
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise StorageError(f"{path}: not a file of initial states; motionese recognise writes them")
    if content.get("version") != VERSION:
        raise StorageError(
            f"{path}: format {content.get('version')}, this version reads {VERSION}; "
            "install a newer motionese"
        )
    try:
        states = {
            str(name): (np.array(one["initial_state"], dtype=np.float64), int(one["rows"]))
            for name, one in content["motions"].items()
        }
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
        raise StorageError(f"{path}: its initial states are incomplete") from error
    for name, (state, rows) in states.items():
        if state.shape != (network.size,) or not (np.abs(state) <= LARGEST).all():
            raise StorageError(
                f"{path}: motion '{name}' needs {network.size} finite numbers, one per unit of "
                f"the model, got {state.size}; was it recognised with another model?"
            )
        if not 2 <= rows <= MOST_ROWS:
            raise StorageError(f"{path}: motion '{name}' has {rows} rows; 2 to {MOST_ROWS} can be")
    if not states:
        raise StorageError(f"{path}: holds no motion")
    return states
