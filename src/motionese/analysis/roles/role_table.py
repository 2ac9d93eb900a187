"""The measures of roles in one table: medians over seeds, a column per condition."""

from collections.abc import Iterable

import pandas as pd

from motionese.analysis.cells import Table, with_interval
from motionese.analysis.statistics import estimate

WAYS = {"": "", "_adam": ", Adam", "_adam_slower": ", Adam, Cf slower"}
MEASURES = {
    **{
        f"{kind}{suffix}": f"{what}{way}"
        for suffix, way in WAYS.items()
        for kind, what in {
            "first_by_cf": "exchange: first stroke follows Cf₀",
            "first_by_cs": "exchange: first stroke follows Cs₀",
            "order_by_cf": "exchange: order follows Cf₀",
            "order_by_cs": "exchange: order follows Cs₀",
            "separation": "separation: the smaller of first by Cf₀ and order by Cs₀",
        }.items()
    },
    **{
        f"{kind}_{lesion}": f"{what}, {how}"
        for kind, what in {"first": "right first strokes", "branch": "right branches"}.items()
        for lesion, how in {
            "intact": "intact",
            "without_cf": "Cf₀ to its mean",
            "without_cs": "Cs₀ to its mean",
            "cut": "Cs → Cf cut",
        }.items()
    },
    "own_direction": "share of the Cs₀ map with the primitive's own direction",
    "order_on_map": "smallest share of the Cs₀ map among the ways on",
    "symbols_right": "sequences read out right",
    "boundaries_right": "of those, boundaries within two steps",
    "symbols_right_alone": "sequences read out right by primitives generated alone",
    "boundaries_right_alone": "of those by primitives alone, boundaries within two steps",
    **{
        f"{what}_from_{level}": f"{what} decoded from {level.capitalize()}"
        for what in ("direction", "position", "order")
        for level in ("cf", "cs")
    },
    "recall_ambiguous_1_cm": "recall of ambiguous strokes, end of stage 1 [cm]",
    "recall_other_1_cm": "recall of other strokes, end of stage 1 [cm]",
    "recall_ambiguous_2_cm": "recall of ambiguous strokes, end of stage 2 [cm]",
    "recall_other_2_cm": "recall of other strokes, end of stage 2 [cm]",
    "untrained_repertoire_cm": "untrained sequences, from the repertoire [cm]",
    "untrained_slow_alone_cm": "untrained sequences, Cf₀ from the repertoire, Cs₀ sought [cm]",
    "right_elements": "motions taken to begin with what they do begin with",
}
"""What is told of, by column of the table of measures."""


def role_table(table: pd.DataFrame, conditions: Iterable[str]) -> Table:
    """Return medians with 95 % intervals, a row per measure of which there is any."""
    names = list(conditions)
    rows = []
    for column, said in MEASURES.items():
        if column in table and table[column].notna().any():
            values = (table.loc[table["condition"] == name, column] for name in names)
            rows.append([said, *(with_interval(estimate(v.to_numpy(dtype=float))) for v in values)])
    return Table(["measure, median over seeds [95 %]", *names], rows)
