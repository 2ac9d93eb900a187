"""The page's tables: claims, effects, errors, what was achieved, the map's numbers, the runs."""

import pandas as pd

from motionese.analysis.cells import NONE, Table, number, with_interval
from motionese.analysis.experiment_data import ExperimentData
from motionese.analysis.map_numbers import SEGMENTS, level_names
from motionese.analysis.seed_measures import Measures, last_loops
from motionese.analysis.statistics import Estimate, estimate
from motionese.task import Outcome


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


def effects_rows(table: pd.DataFrame) -> Table:
    """Return main effects and interactions for the page."""
    rows = []
    for row in table.to_dict("records"):
        found = Estimate(row["statistic"], row["low"], row["high"], row["seeds"])
        rows.append([
            row["effect"], row["measured"], with_interval(found), number(row["p"], 3),
            number(row["effect_size"]), str(row["seeds"]),
        ])  # fmt: skip
    return Table(["effect", "measured", "mean [95 %]", "p", "d", "seeds"], rows)


def errors_table(measures: Measures, data: ExperimentData) -> Table:
    """Return the errors [cm] at the stages' ends and on new sequences."""
    stages = [f"end of stage {number}" for number in measures.error_at_end]
    head = ["condition", "seeds", *stages, "new, trained", "new, untrained", "sd over seeds",
            "residual, untrained"]  # fmt: skip
    new, rows = data.new_sequences, []
    untrained = new[~new["trained"].astype(bool)]
    for name in data.looks:
        columns = [table[name] for table in measures.error_at_end.values()]
        columns += [measures.trained_error[name], measures.untrained_error[name]]
        own = untrained[untrained["condition"] == name]
        residual = own.groupby("seed")["recognition_residual_cm"].mean().astype(float)
        rows.append([
            name,
            str(measures.last_error[name].count()),
            *(with_interval(_over_seeds(column)) for column in columns),
            number(float(measures.untrained_error[name].std())),
            with_interval(_over_seeds(residual)),
        ])  # fmt: skip
    return Table(head, rows)


def success_table(data: ExperimentData) -> Table:
    """Return what was achieved at the stages' ends and in new sequences."""
    loops, new = data.loops, data.new_sequences
    stages = range(1, len(data.study.stages) + 1)
    parts = {f"end of stage {n}": last_loops(loops[loops["phase"] == n]) for n in stages}
    trained = new["trained"].astype(bool)
    parts |= {"new, trained": new[trained], "new, untrained": new[~trained]}
    rows = []
    for name in data.looks:
        for outcome in data.task.outcomes:
            cells = [_achieved(p[p["condition"] == name], outcome) for p in parts.values()]
            rows.append([name, outcome.title, *cells])
    return Table(["condition", "what", *parts], rows)


def map_table(numbers: pd.DataFrame, data: ExperimentData) -> Table:
    """Return the map's numbers, a row per condition and segment."""
    below, top = level_names(data.study)
    shown_below, shown_top = below.capitalize(), top.capitalize()
    head = ["condition", "segment", "resultant length", "within 45°", f"by {shown_below}₀",
            f"by {shown_top}₀", "together", f"{shown_top}→{shown_below} rms before",
            "after"]  # fmt: skip
    shares = [f"share_{name}" for name in (below, top, "together")]
    rows = []
    for condition in data.looks:
        own = numbers[numbers["condition"] == condition]
        if own.empty:
            rows.append([condition, "no slow level, no map", *[NONE] * (len(head) - 2)])
            continue
        weights = [
            number(float(own[f"rms_{top}_to_{below}_{when}"].median()))
            for when in ("before", "after")
        ]
        for segment, called in zip(SEGMENTS, ("first", "second"), strict=True):
            names = ("resultant_length", "within_45", *shares)
            columns = (own[f"{name}_{segment}"] for name in names)
            cells = [with_interval(_over_seeds(column)) for column in columns]
            rows.append([condition, called, *cells, *weights])
    return Table(head, rows)


def runs_table(runs: pd.DataFrame) -> Table:
    """Return how the runs of each condition ended, and how long they took."""
    rows = []
    for condition, own in runs.groupby("condition", sort=False):
        count = own["status"].value_counts()
        rows.append([
            str(condition),
            ", ".join(str(seed) for seed in own["seed"]),
            ", ".join(f"{count[s]} {s}" for s in ("finished", "diverged", "unfinished")
                      if s in count),
            f"{number(float(own['seconds'].median()), 0)} s",
        ])  # fmt: skip
    return Table(["condition", "seeds", "runs", "median duration"], rows)


def failures_table(runs: pd.DataFrame) -> Table:
    """Return the runs that are not finished, with their reasons."""
    failed = runs[runs["status"] != "finished"]
    rows = [
        [str(r.condition), str(r.seed), str(r.status), str(r.reason)] for r in failed.itertuples()
    ]
    return Table(["condition", "seed", "status", "reason"], rows)


def _achieved(rows: pd.DataFrame, outcome: Outcome) -> str:
    if not outcome.of:
        value = number(float(rows[outcome.column].median()), 1) if len(rows) else NONE
        return value if value == NONE else f"{value} {outcome.unit}"
    due, made = int(rows[outcome.of].sum()), int(rows[outcome.column].sum())
    return f"{made} of {due} ({made / due:.0%})" if due else NONE


def _over_seeds(values: "pd.Series[float]") -> Estimate:
    return estimate(values.to_numpy(dtype=float))
