"""The page's tables on what was found: claims, errors, and the map's numbers."""

from collections.abc import Sequence

import pandas as pd

from motionese.analysis.cells import NONE, Table, number, with_interval
from motionese.analysis.map_numbers import SEGMENTS
from motionese.analysis.measures import Measures
from motionese.analysis.statistics import Estimate, estimate
from motionese.experiment.conditions import CONDITIONS, Condition


def claims_rows(table: pd.DataFrame) -> Table:
    """Return the claims for the page: claim, what is measured, numbers, verdict."""
    rows = []
    for row in table.to_dict("records"):
        digits = 3 if row["measured"].endswith("[1]") else 2
        found = Estimate(row["statistic"], row["low"], row["high"], row["seeds"])
        rows.append([
            row["claim"],
            row["measured"],
            with_interval(found, digits),
            number(row["p"], 3),
            number(row["effect"]),
            str(row["seeds"]),
            row["verdict"],
        ])  # fmt: skip
    head = ["claim, and what is measured: positive speaks for it", "mean [95 %]", "p", "d",
            "seeds", "verdict"]  # fmt: skip
    return Table(head, rows)


def errors_table(measures: Measures, triples: pd.DataFrame) -> Table:
    """Return the errors [cm] at the phases' ends and on triples."""
    head = ["condition", "seeds", "end of phase 1", "end of phase 2", "triples, trained",
            "untrained", "sd over seeds", "residual, untrained"]  # fmt: skip
    rows = []
    untrained = triples[~triples["trained"].astype(bool)]
    for condition in _present(measures.last_error):
        name = condition.name
        columns = [
            *(measures.error_at_end[phase][name] for phase in (1, 2)),
            measures.trained_error[name],
            measures.untrained_error[name],
        ]
        estimates = [_over_seeds(column) for column in columns]
        own = untrained[untrained["condition"] == name]
        residual = own.groupby("seed")["recognition_residual_cm"].mean().astype(float)
        rows.append([
            name,
            str(measures.last_error[name].count()),
            *(with_interval(e) for e in estimates),
            number(float(measures.untrained_error[name].std())),
            with_interval(_over_seeds(residual)),
        ])  # fmt: skip
    return Table(head, rows)


def map_table(numbers: pd.DataFrame, conditions: Sequence[Condition]) -> Table:
    """Return the map's numbers, a row per condition and segment."""
    head = ["condition", "segment", "resultant length", "within 45°", "by Cf₀", "by Cs₀",
            "together", "Cs→Cf rms before", "after"]  # fmt: skip
    rows = []
    for condition in conditions:
        own = numbers[numbers["condition"] == condition.name]
        if own.empty:
            rows.append([condition.name, "no slow level, no map", *[NONE] * (len(head) - 2)])
            continue
        for segment in SEGMENTS:
            names = ("resultant_length", "within_45", "share_cf", "share_cs", "share_together")
            weights = [
                number(float(own[f"rms_cs_to_cf_{when}"].median())) for when in ("before", "after")
            ]
            rows.append([
                condition.name,
                "first" if segment == 1 else "second",
                *(with_interval(_over_seeds(own[f"{name}_{segment}"])) for name in names),
                *weights,
            ])  # fmt: skip
    return Table(head, rows)


def _present(by_seed: pd.DataFrame) -> list[Condition]:
    return [c for c in CONDITIONS if by_seed[c.name].notna().any()]


def _over_seeds(values: "pd.Series[float]") -> Estimate:
    return estimate(values.to_numpy(dtype=float))
