"""The short answer on top of the report: sentences assembled from verdicts and numbers."""

from collections.abc import Sequence

import pandas as pd

from motionese.analysis.claims import SAME
from motionese.analysis.map_numbers import listed, warnings
from motionese.analysis.measures import Measures
from motionese.analysis.statistics import estimate
from motionese.analysis.verdicts import Judgement, judge_alone
from motionese.experiment.conditions import CONDITIONS

QUESTION = "When do clear primitives emerge inside the network?"


def answer(measures: Measures, numbers: pd.DataFrame) -> list[str]:
    """Return the answer's sentences.

    Args:
        measures: What the claims are about.
        numbers: A row per condition and seed on its map.
    """
    return [*_emergence(measures), *warnings(numbers)]


def main_claims(results: Sequence[Judgement]) -> list[tuple[str, str]]:
    """Return the paper's own claims, each with its verdict."""
    return [(each.claim.text, each.verdict) for each in results if each.claim.main]


def _emergence(measures: Measures) -> list[str]:
    lengths = measures.resultant_length
    found: dict[str, list[str]] = {"holds": [], "does not hold": [], "undecided": []}
    for condition in CONDITIONS:
        values = lengths[condition.name].dropna()
        if values.empty:
            continue
        middle = estimate(values.to_numpy(dtype=float)).value
        verdict = judge_alone(values - SAME)
        group = "undecided" if verdict.startswith("undecided") else verdict
        found[group].append(f"{condition.name} ({middle:.2f})")
    if not any(found.values()):
        return ["No run that ended has a slow level whose map could answer it."]
    words = {"holds": "yes in", "does not hold": "no in", "undecided": "undecided in"}
    told = "; ".join(f"{words[group]} {listed(names)}" for group, names in found.items() if names)
    return [
        "A primitive is clear where its Cf₀ alone sets the direction of the hand, whatever Cs₀ is: "
        f"the directions' mean resultant length over the map of Cs₀ is then at least {SAME}. "
        f"After the last loop, with medians over the seeds: {told}."
    ]
