"""Single cells of a table: what is a number, and how it is written."""

from collections.abc import Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

MISSING = ("na", "n/a", "null", "none")
"""Words for a value that was not observed, as an empty cell is. NaN is a value."""
TRUTH = {"true": "1", "false": "0"}


def floats(cells: Sequence[str]) -> Float[ndarray, " T"]:
    """Return cells as numbers, NaN where one is empty; `ValueError` where one is text."""
    return np.array([float(cell) if cell else np.nan for cell in cells], dtype=np.float64)


def is_number(cell: str) -> bool:
    """Tell whether a cell holds a number."""
    try:
        float(cell)
    except ValueError:
        return False
    return True


def plain(cell: str, *, decimal_comma: bool) -> str:
    """Return a cell as Python writes its number; empty where nothing was observed."""
    folded = cell.casefold()
    if folded in MISSING:
        return ""
    return TRUTH.get(folded, cell.replace(",", ".") if decimal_comma else cell)
