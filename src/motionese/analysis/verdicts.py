"""What the runs say to the claims.

A claim of several parts holds only if every part does (an intersection–union test, which needs no
correction), so the row that is reported for it is its weakest part. It does not hold as soon as one
part speaks against it: the more parts, the more easily one does so by chance, and for that verdict
the level is divided by their number (Bonferroni).
"""

from collections.abc import Sequence
from math import inf, nan
from typing import NamedTuple

import numpy as np
import pandas as pd

from motionese.analysis.statistics import Contrast, contrast, verdict
from motionese.errors import TooFewSeedsError

COLUMNS = ["claim", "measured", "statistic", "low", "high", "p", "effect", "seeds", "verdict"]


class Part(NamedTuple):
    """What is measured, and its difference by seed, positive where it speaks for the claim."""

    measured: str
    differences: "pd.Series[float]"


class Claim(NamedTuple):
    """A claim in plain words; `main` marks those of a paper itself."""

    text: str
    parts: tuple[Part, ...]
    main: bool = False


class Judgement(NamedTuple):
    """A claim with its verdict, and the weakest part, which decides it.

    `contrast` is what the seeds say to that part; None with fewer than two of them.
    """

    claim: Claim
    part: Part
    contrast: Contrast | None
    seeds: int
    verdict: str


def judge(claim: Claim) -> Judgement:
    """Test a claim: every part, of which the weakest decides."""
    return min((_judge_part(claim, part) for part in claim.parts), key=_strength)


def judge_alone(differences: "pd.Series[float]") -> str:
    """Return the verdict on a difference by seed that is no part of a claim."""
    return judge(Claim("", (Part("", differences),))).verdict


def claims_table(results: Sequence[Judgement]) -> pd.DataFrame:
    """Return a row per claim."""
    rows = []
    for each in results:
        numbers = each.contrast or Contrast(nan, nan, nan, nan, nan, each.seeds)
        rows.append([each.claim.text, each.part.measured, *numbers, each.verdict])
    return pd.DataFrame(rows, columns=COLUMNS)


def _judge_part(claim: Claim, part: Part) -> Judgement:
    differences = part.differences.dropna()
    seeds = len(differences)
    try:
        found = contrast(differences.to_numpy(dtype=np.float64), part.measured)
    except TooFewSeedsError:
        return Judgement(claim, part, None, seeds, verdict(None, seeds))
    return Judgement(claim, part, found, seeds, verdict(found, parts=len(claim.parts)))


def _strength(part: Judgement) -> tuple[int, float]:
    place = {"does not hold": 0, "holds": 2}.get(part.verdict, 1)
    return place, part.contrast.effect if part.contrast else -inf
