"""Runs beside the kept ones: what was measured in both, and where the medians lie outside."""

from collections.abc import Iterable
from itertools import chain
from math import inf, isfinite, nan
from typing import NamedTuple

import numpy as np
import pandas as pd
from jaxtyping import Float
from numpy import ndarray

from motionese.analysis.roles.role_table import MEASURES as ROLES
from motionese.analysis.statistics import Estimate, estimate

CENTRAL = (2.5, 97.5)
"""Percentiles between which single kept seeds count as usual."""
SLACK = 1e-5
"""As a share of the bound: kept numbers have six digits."""


TITLES = {
    "map_length_1": "resultant length over the Cs₀ map, first stroke",
    "map_length_2": "resultant length over the Cs₀ map, second stroke",
    "end_of_stage_1_cm": "error at the end of stage 1 [cm]",
    "end_of_stage_2_cm": "error at the end of stage 2 [cm]",
    "pressed": "presses made of those due",
    "untrained_cm": "untrained sequences, by long search [cm]",
    "untrained_spread_cm": "spread over untrained sequences [cm]",
    **ROLES,
}
"""What measures are called, by column."""
SHOWN = {
    "Who is followed after an exchange": (
        *("first_by_cf", "order_by_cs", "separation", "separation_adam", "separation_adam_slower"),
    ),
    "What lesions spare": (
        *("first_without_cf", "first_without_cs", "branch_without_cf", "branch_without_cs"),
        "branch_cut",
    ),
    "The map of Cs₀": ("map_length_1", "map_length_2", "own_direction", "order_on_map"),
    "Imitation": (
        *("end_of_stage_1_cm", "end_of_stage_2_cm", "pressed", "untrained_cm"),
        *("untrained_spread_cm", "untrained_repertoire_cm", "untrained_slow_alone_cm"),
    ),
    "Symbols, recall and decoders": (
        *("symbols_right", "boundaries_right", "symbols_right_alone"),
        *("recall_ambiguous_1_cm", "recall_ambiguous_2_cm"),
        *("direction_from_cf", "direction_from_cs", "order_from_cf", "order_from_cs"),
    ),
}
"""Columns that runs are compared in, under the headings of the page."""


class Beside(NamedTuple):
    """A measure in a condition: the kept runs' numbers, and those of the runs beside them.

    Attributes:
        kept: Median over the kept seeds, with its 95 % interval.
        usual: Ends of the range in which the central 95 % of single kept seeds lie.
        median: That of the runs beside them.
        seeds: How many these have.
        place: Of that median: "inside" or "outside" the usual range; "" where one is missing.
    """

    measure: str
    condition: str
    kept: Estimate
    usual: tuple[float, float]
    median: float
    seeds: int
    place: str


def beside_kept(kept: pd.DataFrame | None, own: pd.DataFrame) -> list[Beside]:
    """Return an entry for every measure and condition that has a value.

    Args:
        kept: Measures of the kept runs by condition and seed, or None where there are none.
        own: The same of the runs that are set beside them.
    """
    found = []
    for measure in chain.from_iterable(SHOWN.values()):
        for condition in _conditions(kept, own):
            before, now = (values_of(t, condition, measure) for t in (kept, own))
            if not len(before) + len(now):
                continue
            low, high = np.percentile(before, CENTRAL) if len(before) else (nan, nan)
            median, usual = float(np.median(now)) if len(now) else nan, (float(low), float(high))
            who, place = (measure, condition), _place(median, *usual)
            found.append(Beside(*who, estimate(before), usual, median, len(now), place))
    return found


def beside_table(beside: Iterable[Beside]) -> pd.DataFrame:
    """Return the same as a table, a row an entry."""
    columns = ["measure", "condition", "kept_median", "kept_low", "kept_high", "kept_seeds"]
    columns += ["usual_low", "usual_high", "median", "seeds", "place"]
    rows = [
        [each.measure, each.condition, *each.kept, *each.usual, each.median, each.seeds, each.place]
        for each in beside
    ]
    return pd.DataFrame(rows, columns=columns)


def values_of(table: pd.DataFrame | None, condition: str, column: str) -> Float[ndarray, " n"]:
    """Return what there is of a measure in a condition, a value a seed."""
    if table is None or column not in table:
        return np.empty(0)
    values = table.loc[table["condition"] == condition, column].replace([inf, -inf], nan)
    return values.dropna().to_numpy(dtype=np.float64)


def _conditions(*tables: pd.DataFrame | None) -> Iterable[str]:
    return dict.fromkeys(c for table in tables if table is not None for c in table["condition"])


def _place(median: float, low: float, high: float) -> str:
    if not all(map(isfinite, (median, low, high))):
        return ""
    slack = SLACK * max(abs(low), abs(high))
    return "inside" if low - slack <= median <= high + slack else "outside"
