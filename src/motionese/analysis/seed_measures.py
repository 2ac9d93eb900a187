"""What is compared: one number per condition and seed, for every measure."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import pandas as pd

from motionese.analysis.experiment_data import ExperimentData
from motionese.analysis.map_numbers import level_names
from motionese.task import Outcome

LAST_LOOPS = 3
"""The error at the end of a stage is the mean over its last loops."""


@dataclass(frozen=True)
class Measures:
    """Tables with a row per seed and a column per condition, NaN where there is no such run.

    Attributes:
        error_at_end: Imitation error [cm] at the end of every stage, by its number from 1.
        achieved: The outcomes [share, or the outcome's unit] in the last loops, by their titles.
        trained_error: Mean imitation error [cm] of the new sequences made of taught pairs.
        untrained_error: The same of those with a pair that was never taught.
        untrained_spread: Standard deviation [cm] of the latter over the sequences.
        resultant_length: Mean resultant length of the first segment's direction over the map.
        slow_level_part: Share of the variance of the second's that the top level takes part in.
    """

    error_at_end: dict[int, pd.DataFrame]
    achieved: dict[str, pd.DataFrame]
    trained_error: pd.DataFrame
    untrained_error: pd.DataFrame
    untrained_spread: pd.DataFrame
    resultant_length: pd.DataFrame
    slow_level_part: pd.DataFrame

    @property
    def last_error(self) -> pd.DataFrame:
        """Imitation error [cm] at the end of the last stage."""
        return self.error_at_end[max(self.error_at_end)]


def measured(data: ExperimentData, numbers: pd.DataFrame) -> Measures:
    """Return the measures of runs, and of `numbers`, a row per condition and seed on its map."""
    names = [condition.name for condition in data.study.conditions]

    def whole(table: pd.DataFrame) -> pd.DataFrame:
        return table.reindex(columns=names)

    loops, new = data.loops, data.new_sequences
    trained, error = new["trained"].astype(bool), "imitation_error_cm"
    below, _ = level_names(data.study)
    kept = numbers.assign(part=1 - numbers[f"share_{below}_2"])
    stages, at_end = range(1, len(data.study.stages) + 1), last_loops(loops)
    return Measures(
        error_at_end={n: whole(error_at_end(loops, n)) for n in stages},
        achieved={each.title: whole(achieved(at_end, each)) for each in data.task.outcomes},
        trained_error=whole(_by_seed(new[trained], error)),
        untrained_error=whole(_by_seed(new[~trained], error)),
        untrained_spread=whole(_by_seed(new[~trained], error, "std")),
        resultant_length=whole(_by_seed(numbers, "resultant_length_1")),
        slow_level_part=whole(_by_seed(kept, "part")),
    )


def last_loops(loops: pd.DataFrame, stage: int | None = None) -> pd.DataFrame:
    """Return the rows of each run's last loops up to the end of a stage, or of the last one.

    A stage that was shorter than that has none of the stage before. A run that diverged before
    keeps its last loops: to leave it out would make its condition look better than it is.
    """
    early = loops if stage is None else loops[loops["phase"] <= stage]
    last = early.groupby(["condition", "seed"])[["loop", "phase"]].transform("max")
    return early[(early["loop"] > last["loop"] - LAST_LOOPS) & (early["phase"] == last["phase"])]


def error_at_end(loops: pd.DataFrame, stage: int) -> pd.DataFrame:
    """Return the mean imitation error [cm] of each run's last loops up to the end of a stage."""
    by_loop = last_loops(loops, stage).groupby(["condition", "seed", "loop"], as_index=False)
    return _by_seed(by_loop[["imitation_error_cm"]].mean(), "imitation_error_cm")


def achieved(
    rows: pd.DataFrame, outcome: Outcome, index: Sequence[str] = ("seed",)
) -> pd.DataFrame:
    """Return what was achieved in some rows: a share of what was due, or the mean.

    The result has a row for each value of `index`, and a column per condition.
    """
    group = rows.groupby([*index, "condition"])
    if not outcome.of:
        return group[outcome.column].mean().unstack("condition").astype(float)
    counts = group[[outcome.of, outcome.column]].sum()
    due = counts[outcome.of].where(lambda n: n > 0)
    return (counts[outcome.column] / due).unstack("condition").astype(float)


def typical_seed(by_seed: "pd.Series[float]") -> int:
    """Return the seed with the median value, the lower one of two."""
    kept = by_seed.dropna().sort_index().sort_values(kind="stable")
    return int(str(kept.index[(len(kept) - 1) // 2]))


def _by_seed(
    table: pd.DataFrame, column: str, statistic: Literal["mean", "std"] = "mean"
) -> pd.DataFrame:
    wide = table.pivot_table(index="seed", columns="condition", values=column, aggfunc=statistic)
    return wide.astype(float).sort_index()
