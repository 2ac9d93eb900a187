"""A cell of a text table: what in it is a number, a word, or nothing."""

from collections.abc import Sequence
from datetime import datetime

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


def is_value(cell: str) -> bool:
    """Tell whether a cell holds what stands in rows of a table, not in lines of words above it."""
    return (
        is_number(cell.replace(",", "."))
        or plain(cell, decimal_comma=False) != cell
        or moment(cell) is not None
    )


def plain(cell: str, *, decimal_comma: bool) -> str:
    """Return a cell as Python writes its number; empty where nothing was observed."""
    folded = cell.casefold()
    if folded in MISSING:
        return ""
    return TRUTH.get(folded, cell.replace(",", ".") if decimal_comma else cell)


def moment(cell: str) -> datetime | None:
    """Return a date, perhaps with its time of day, or a time of day alone; None for others."""
    for text in (cell, f"1970-01-01T{cell}"):
        try:
            return datetime.fromisoformat(text)
        except ValueError:
            continue
    return None
