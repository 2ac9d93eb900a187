"""Numbers and names as the page writes them, and tables of such cells."""

import math
from collections.abc import Sequence
from typing import NamedTuple

from motionese.analysis.statistics import Estimate

NONE = "–"


class Table(NamedTuple):
    """Column headings and rows of cells."""

    head: Sequence[str]
    rows: Sequence[Sequence[str]]


def number(value: float, digits: int = 2) -> str:
    """Return a number as text, a dash where there is none."""
    if not math.isfinite(value):
        return NONE
    rounded = round(value, digits) + 0.0  # no minus before a zero
    return f"{rounded:.{digits}f}".replace("-", "−")


def probability(p: float) -> str:
    """Return a p value as text; one that rounds to 0 is not 0."""
    return "< 0.001" if p < 0.0005 else number(p, 3)


def with_interval(found: Estimate, digits: int = 2) -> str:
    """Return 'value [low, high]', the value alone where one seed is all."""
    value = number(found.value, digits)
    if not math.isfinite(found.low):
        return value
    return f"{value} [{number(found.low, digits)}, {number(found.high, digits)}]"


def listed(names: Sequence[str]) -> str:
    """Return names as a list in words."""
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
