"""The page's tables on the runs themselves: buttons pressed, durations, failures."""

import math

import pandas as pd

from motionese.analysis.cells import NONE, Table, number
from motionese.analysis.collected import Collected
from motionese.analysis.measures import LAST_LOOPS
from motionese.experiment.conditions import CONDITIONS


def buttons_table(collected: Collected) -> Table:
    """Return how many due presses were made, and how deep they were."""
    head = ["condition", "end of phase 1", "end of phase 2", "triples, trained", "untrained"]
    loops, triples = collected.loops, collected.triples
    taught = triples["trained"].astype(bool)
    rows = []
    for condition in collected.conditions:
        own = loops[loops["condition"] == condition.name]
        parts = [_last_loops(own[own["phase"] == phase]) for phase in (1, 2)]
        parts += [chosen[chosen["condition"] == condition.name] for chosen in
                  (triples[taught], triples[~taught])]  # fmt: skip
        rows.append([condition.name, *(_presses(part) for part in parts)])
    return Table(head, rows)


def runs_table(runs: pd.DataFrame) -> Table:
    """Return how the runs of each condition ended, and how long they took."""
    rows = []
    for condition in CONDITIONS:
        own = runs[runs["condition"] == condition.name]
        if own.empty:
            continue
        count = own["status"].value_counts()
        rows.append([
            condition.name,
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


def _last_loops(rows: pd.DataFrame) -> pd.DataFrame:
    return rows[rows["loop"] > rows["loop"].max() - LAST_LOOPS] if len(rows) else rows


def _presses(rows: pd.DataFrame) -> str:
    due, made = int(rows["buttons_due"].sum()), int(rows["buttons_pressed"].sum())
    if not due:
        return NONE
    depth = rows["press_depth_mm"].median() if "press_depth_mm" in rows else math.nan
    deep = f", {number(float(depth), 1)} mm" if math.isfinite(float(depth)) else ""
    return f"{made} of {due} ({made / due:.0%}{deep})"
