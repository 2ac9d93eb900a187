"""Main effects of the factors of a study, and interactions, on what is measured at its end."""

from collections.abc import Iterator, Mapping
from itertools import combinations, product

import numpy as np
import pandas as pd

from motionese.analysis.seed_measures import Measures
from motionese.analysis.statistics import Contrast, contrast
from motionese.errors import TooFewSeedsError

COLUMNS = ["effect", "measured", "statistic", "low", "high", "p", "effect_size", "seeds"]


def effects(
    measures: Measures,
    factors: Mapping[str, tuple[str, ...]],
    further: Mapping[str, pd.DataFrame] | None = None,
) -> pd.DataFrame:
    """Return a row per effect and measure: the mean difference over seeds, its interval and test.

    `further` are measures beside those of all studies, by what they are called.

    A main effect is the mean over the conditions with a factor's second choice minus that over
    those with its first; an interaction of two factors half the difference of such effects. Only
    factors of two choices have them, and only seeds that were run in all conditions count.
    """
    tables = {f"error at the end of stage {n} [cm]": t for n, t in measures.error_at_end.items()}
    tables |= measures.achieved
    tables["error on new sequences, trained [cm]"] = measures.trained_error
    tables["error on new sequences, untrained [cm]"] = measures.untrained_error
    tables |= further or {}
    rows = []
    for what, table in tables.items():
        complete = table.dropna()
        for name, weights in _weights(factors):
            if complete.empty:
                continue
            differences = (complete[list(weights)] * pd.Series(weights)).sum(axis=1)
            found = _tested(differences.to_numpy(dtype=np.float64), f"{name}, {what}")
            rows.append([name, what, *found])
    return pd.DataFrame(rows, columns=COLUMNS)


def _weights(factors: Mapping[str, tuple[str, ...]]) -> Iterator[tuple[str, dict[str, float]]]:
    """Yield effects by name, each with the weight of every condition."""
    conditions = {"/".join(choices): choices for choices in product(*factors.values())}
    two = [(place, choices) for place, choices in enumerate(factors.values()) if len(choices) == 2]
    half = len(conditions) / 2
    sign = {
        (name, place): 1.0 if choices[place] == pair[1] else -1.0
        for name, choices in conditions.items()
        for place, pair in two
    }
    for place, (one, other) in two:
        yield f"{other} − {one}", {name: sign[name, place] / half for name in conditions}
    for (a, first), (b, second) in combinations(two, 2):
        yield (
            f"({first[1]} − {first[0]}) × ({second[1]} − {second[0]})",
            {name: sign[name, a] * sign[name, b] / half for name in conditions},
        )


def _tested(differences: np.ndarray, what: str) -> Contrast:
    try:
        return contrast(differences, what)
    except TooFewSeedsError:
        value, nan = float(differences.mean()), np.nan
        return Contrast(value, nan, nan, nan, nan, len(differences))
