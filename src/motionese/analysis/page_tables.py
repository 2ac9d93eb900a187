"""The page's tables: claims, effects, errors, what was achieved, the map's numbers, the runs."""

from collections.abc import Sequence
from typing import Any

import pandas as pd

from motionese.analysis.cells import NONE, Table, number, probability, with_interval
from motionese.analysis.experiment_data import ExperimentData
from motionese.analysis.map_numbers import SEGMENTS, level_names
from motionese.analysis.mochizuki2013.findings import Finding
from motionese.analysis.seed_measures import Measures, last_loops
from motionese.analysis.statistics import Estimate, estimate
from motionese.analysis.while_shown import AT_ONCE, KINDS
from motionese.experiment import Study, stage_lessons
from motionese.task import Outcome

MIDDLE = (2,)
"""Lags that the page tells of, beside the first and the last."""
TESTED = ["mean [95 %]", "p", "d", "seeds"]


def claims_rows(table: pd.DataFrame) -> Table:
    """Return the claims for the page: claim, what is measured, numbers, verdict."""
    head = ["claim, and what is measured: positive speaks for it", *TESTED, "verdict"]
    return Table(head, [[*_tested(row), row[-1]] for row in table.itertuples(index=False)])


def findings_rows(found: Sequence[Finding]) -> Table:
    """Return what was planned to be tested, for the page: finding, measured, numbers, verdict."""
    head = ["finding, and what is measured: positive speaks for it", "mean [95 %]", "p"]
    head += ["corrected", "d", "seeds", "left out", "verdict"]
    rows = []
    for each in found:
        interval = with_interval(Estimate(each.statistic, each.low, each.high, each.seeds))
        p, d = (probability(each.p), probability(each.p_corrected)), number(each.effect)
        counts = str(each.seeds), str(each.left_out)
        text = f"{each.family}: {each.text}"
        rows.append([text, each.measured, interval, *p, d, *counts, each.verdict])
    return Table(head, rows)


def effects_rows(table: pd.DataFrame) -> Table:
    """Return main effects and interactions for the page."""
    rows = [_tested(row) for row in table.itertuples(index=False)]
    return Table(["effect", "measured", *TESTED], rows)


def _tested(row: Sequence[Any]) -> list[str]:
    """Return what is tested, how it is measured, and the contrast, in words."""
    what, measured, value, low, high, p, effect, seeds, *_ = row
    digits = 3 if measured.endswith("[1]") else 2
    interval = with_interval(Estimate(value, low, high, seeds), digits)
    return [what, measured, interval, probability(p), number(effect), str(seeds)]


def lessons_table(study: Study) -> Table:
    """Return what is taught in every stage, and what memory of order that demands."""
    lessons = stage_lessons(study)
    head = ["stage", "conditions", "lesson", *lessons[0].numbers, "what it asks for"]
    rows = []
    for each in lessons:
        taught = [str(each.stage), each.conditions, each.name or each.sequences]
        rows.append([*taught, *each.numbers.values(), each.demand.sentence])
    return Table(head, rows)


def errors_table(measures: Measures, data: ExperimentData) -> Table:
    """Return the errors [cm] at the stages' ends and on new sequences."""
    head = ["condition", "seeds", *(f"end of stage {number}" for number in measures.error_at_end)]
    head += ["new, trained", "new, untrained", "sd over seeds", "residual, untrained"]
    new, rows = data.new_sequences, []
    untrained = new[~new["trained"].astype(bool)]
    for name in data.looks:
        columns = [table[name] for table in measures.error_at_end.values()]
        columns += [measures.trained_error[name], measures.untrained_error[name]]
        own = untrained[untrained["condition"] == name]
        columns += [own.groupby("seed")["recognition_residual_cm"].mean().astype(float)]
        *intervals, residual = map(_over_seeds, columns)
        seeds, sd = measures.last_error[name].count(), measures.untrained_error[name].std()
        rows.append([name, str(seeds), *intervals, number(float(sd)), residual])
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


def online_table(data: ExperimentData) -> Table:
    """Return the errors [cm] of imitation while watching, and how soon a turn is noticed."""
    online, lags = data.online, sorted(data.online["lag"].unique())
    shown = [(kind, lag) for kind in KINDS for lag in sorted({*lags[:1], *lags[-1:], *MIDDLE})]
    shown = [(kind, lag) for kind, lag in shown if lag in lags]
    head = ["condition", *(f"{'taught' if k else 'new'}, lag {lag}" for k, lag in shown)]
    head += ["new, from the repertoire", f"turns noticed within {AT_ONCE} rows", "median [rows]"]
    rows = []
    for name in data.looks:
        own = online[online["condition"] == name]
        cells = [_by_seed(own[(own["taught"] == k) & (own["lag"] == lag)]) for k, lag in shown]
        new, turns = (t[t["condition"] == name] for t in (data.new_sequences, data.switches))
        cells.append(_by_seed(new, "repertoire_imitation_error_cm") if len(new) else NONE)
        steps = turns["steps"].astype(float)
        at_once = f"{(steps <= AT_ONCE).sum()} of {len(turns)}" if len(turns) else NONE
        rows.append([name, *cells, at_once, number(float(steps.median()), 0)])
    return Table(head, rows)


def _by_seed(rows: pd.DataFrame, column: str = "imitation_error_cm") -> str:
    return _over_seeds(rows.groupby("seed")[column].mean().astype(float))


def map_table(numbers: pd.DataFrame, data: ExperimentData) -> Table:
    """Return the map's numbers, a row per condition and segment."""
    below, top = level_names(data.study)
    shown_below, shown_top = below.capitalize(), top.capitalize()
    head = ["condition", "segment", "resultant length", "within 45°", f"by {shown_below}₀"]
    head += [f"by {shown_top}₀", "together", f"{shown_top}→{shown_below} rms before", "after"]
    shares = [f"share_{name}" for name in (below, top, "together")]
    rows = []
    for condition in data.looks:
        own = numbers[numbers["condition"] == condition]
        if own.empty:
            rows.append([condition, "no slow level, no map", *[NONE] * (len(head) - 2)])
            continue
        block = own[[f"rms_{top}_to_{below}_{when}" for when in ("before", "after")]]
        weights = [number(middle) for middle in block.median()]
        for segment, called in zip(SEGMENTS, ("first", "second"), strict=True):
            names = ("resultant_length", "within_45", *shares)
            columns = (own[f"{name}_{segment}"] for name in names)
            rows.append([condition, called, *map(_over_seeds, columns), *weights])
    return Table(head, rows)


def runs_table(runs: pd.DataFrame) -> Table:
    """Return how the runs of each condition ended, and how long they took."""
    rows = []
    for condition, own in runs.groupby("condition", sort=False):
        count, seeds = own["status"].value_counts(), ", ".join(map(str, own["seed"]))
        ends = [f"{count[s]} {s}" for s in ("finished", "diverged", "unfinished") if s in count]
        duration = f"{number(float(own['seconds'].median()), 0)} s"
        rows.append([str(condition), seeds, ", ".join(ends), duration])
    return Table(["condition", "seeds", "runs", "median duration"], rows)


def failures_table(runs: pd.DataFrame) -> Table:
    """Return the runs that are not finished, with their reasons."""
    head = ["condition", "seed", "status", "reason"]
    failed = runs.loc[runs["status"] != "finished", head]
    return Table(head, [[str(cell) for cell in row] for row in failed.itertuples(index=False)])


def _achieved(rows: pd.DataFrame, outcome: Outcome) -> str:
    if not outcome.of:
        value = number(float(rows[outcome.column].median()), 1) if len(rows) else NONE
        return value if value == NONE else f"{value} {outcome.unit}"
    due, made = int(rows[outcome.of].sum()), int(rows[outcome.column].sum())
    return f"{made} of {due} ({made / due:.0%})" if due else NONE


def _over_seeds(values: "pd.Series[float]") -> str:
    return with_interval(estimate(values.to_numpy(dtype=float)))
