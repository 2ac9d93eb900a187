"""What the claims are about: one number per condition and seed, for every measure."""

from dataclasses import dataclass
from typing import Literal

import pandas as pd

from motionese.experiment.conditions import CONDITIONS
from motionese.experiment.settings import Phases

LAST_LOOPS = 3
"""The error at the end of a phase is the mean over its last loops."""


@dataclass(frozen=True)
class Measures:
    """Tables with a row per seed and a column per condition, NaN where there is no such run.

    Attributes:
        error_at_end: Imitation error [cm] at the end of phase 1 and of phase 2; without rows for a
            phase of no loops.
        trained_error: Mean imitation error [cm] of the triples made of taught pairs.
        untrained_error: The same of those with a pair that is never taught.
        untrained_spread: Standard deviation [cm] of the latter over the motions.
        resultant_length: Mean resultant length of the first segment's direction over the map.
        slow_level_part: Share of the second segment's direction variance Cs_0 takes part in.
    """

    error_at_end: dict[int, pd.DataFrame]
    trained_error: pd.DataFrame
    untrained_error: pd.DataFrame
    untrained_spread: pd.DataFrame
    resultant_length: pd.DataFrame
    slow_level_part: pd.DataFrame

    @property
    def last_error(self) -> pd.DataFrame:
        """Imitation error [cm] at the end of the last phase that has loops."""
        return self.error_at_end[1 if self.error_at_end[2].empty else 2]


def measured(
    loops: pd.DataFrame, triples: pd.DataFrame, numbers: pd.DataFrame, phases: Phases
) -> Measures:
    """Return the measures.

    Args:
        loops: A row per condition, seed, loop and motion.
        triples: A row per condition, seed and new motion.
        numbers: A row per condition and seed on its map.
        phases: Which loops the phases have.
    """
    taught = triples["trained"].astype(bool)
    kept = numbers.assign(part=1 - numbers["share_cf_2"])
    # Up to the end of a phase 2 of no loops, phase 1's would be taken for its error.
    second = loops if phases.change_after < phases.loops else loops.iloc[:0]
    return Measures(
        error_at_end={1: error_at_end(loops, 1), 2: error_at_end(second, 2)},
        trained_error=_by_seed(triples[taught], "imitation_error_cm"),
        untrained_error=_by_seed(triples[~taught], "imitation_error_cm"),
        untrained_spread=_by_seed(triples[~taught], "imitation_error_cm", "std"),
        resultant_length=_by_seed(numbers, "resultant_length_1"),
        slow_level_part=_by_seed(kept, "part"),
    )


def error_at_end(loops: pd.DataFrame, phase: int) -> pd.DataFrame:
    """Return the mean imitation error [cm] of each run's last loops up to the end of a phase.

    A run that diverged before keeps the error of its last loops: to leave it out would make its
    condition look better than it is.
    """
    early = loops[loops["phase"] <= phase]
    by_loop = early.groupby(["condition", "seed", "loop"], as_index=False)[
        ["imitation_error_cm"]
    ].mean()
    last = by_loop.sort_values("loop").groupby(["condition", "seed"]).tail(LAST_LOOPS)
    return _by_seed(last, "imitation_error_cm")


def typical_seed(by_seed: "pd.Series[float]") -> int:
    """Return the seed with the median value, the lower one of two."""
    kept = by_seed.dropna().sort_index().sort_values(kind="stable")
    return int(str(kept.index[(len(kept) - 1) // 2]))


def _by_seed(
    table: pd.DataFrame, column: str, statistic: Literal["mean", "std"] = "mean"
) -> pd.DataFrame:
    wide = table.pivot_table(index="seed", columns="condition", values=column, aggfunc=statistic)
    return wide.reindex(columns=[c.name for c in CONDITIONS]).astype(float).sort_index()
