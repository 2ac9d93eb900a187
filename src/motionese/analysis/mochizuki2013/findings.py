"""What was planned to be tested (docs/plan.md), and what the runs say to it.

The plan was written before its runs were made. Its tests are of paired differences over seeds,
positive where they speak for the finding, and corrected within each of its families.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from math import isnan, nan
from typing import NamedTuple

import numpy as np
import pandas as pd

from motionese.analysis.mochizuki2013.claims import OTHERS, SAME, TD_MD, TD_MND, TND_MD, TND_MND
from motionese.analysis.statistics import DECIDING, Contrast, contrast, estimate, holm, verdict
from motionese.errors import TooFewSeedsError
from motionese.experiment import Study
from motionese.experiment.presets import read_settings

ORDER, DEFAULT, FREE = "order", "default", "free"
CLEAR = 0.9
"""From this separation on the roles of a run are clear."""
SEPARATION, MAP = "Separation", "Claim (c)"
NEW, LEARNING, GENERALISATION = "Claim (b)", "Claim (a)", "Generalisation"

Tables = Mapping[str, pd.DataFrame]
"""Measures of runs (as of `seed_table`) by the preset that they were made with."""


class PlannedTest(NamedTuple):
    """A test of a family: what is said, how it is measured, and its difference by seed.

    `against` is what TD/MD, or TND/MD, is compared with, or the condition that is asked about.
    """

    family: str
    text: str
    measured: str
    differences: "pd.Series[float]"
    against: str = ""


class Finding(NamedTuple):
    """What the seeds say to a test, or to what a family of them is about (`main`).

    Attributes:
        statistic: The mean difference with its 95 % interval; of a `main` one the median.
        p: Of the sign-flip permutation test; `p_corrected` after Holm, within the family.
        effect: Cohen's d of paired differences.
        left_out: Seeds that have nothing to measure, such as those that diverged.
        verdict: "holds", "does not hold" or "undecided with n seeds", by the corrected p.
    """

    family: str
    text: str
    measured: str
    statistic: float
    low: float
    high: float
    p: float
    p_corrected: float
    effect: float
    seeds: int
    left_out: int
    verdict: str
    against: str = ""
    main: bool = False


def preset_of(study: Study) -> str | None:
    """Return which of the plan's presets runs were made with, or None for other settings.

    How many demonstrations roles are measured of, and by which controls beside, may differ.
    """
    for name in (ORDER, DEFAULT, FREE):
        preset = read_settings(name)
        evaluation = preset.evaluation.model_copy(update={"roles": study.evaluation.roles})
        if preset.model_copy(update={"evaluation": evaluation}) == study:
            return name
    return None


def findings(tables: Tables) -> list[Finding]:
    """Return what the runs say to every test of the plan whose tables there are."""
    found: list[Finding] = []
    for family, tests in groupby(_planned(tables), lambda test: test.family):
        answered = tested(list(tests))
        if family == SEPARATION:
            lengths = _by_seed(tables[ORDER], "separation")[TD_MD]
            text = f"Only {TD_MD} separates the roles"
            found.append(
                _together(text, lengths, CLEAR, [t for t in answered if t.against != FREE])
            )
        if family == MAP:
            lengths = _by_seed(tables[DEFAULT], "map_length_1")[TD_MD]
            text = f"With Cf₀ held, the direction is the same over the Cs₀ map in {TD_MD} only"
            found.append(_together(text, lengths, SAME, answered))
        found += answered
    return found


def findings_table(found: Iterable[Finding]) -> pd.DataFrame:
    """Return a row per finding."""
    return pd.DataFrame(list(found), columns=Finding._fields)


def _planned(tables: Tables) -> Iterator[PlannedTest]:
    if ORDER in tables:
        separation = _by_seed(tables[ORDER], "separation")
        yield from _better(SEPARATION, separation, "separates the roles more", "separation [1]", -1)
        if FREE in tables:
            free = _by_seed(tables[FREE], "separation")[TD_MD]
            text = f"{TD_MD} separates the roles more where motions share initial states"
            what = "shared − free, separation [1]"
            yield PlannedTest(SEPARATION, text, what, separation[TD_MD] - free, FREE)
    if DEFAULT in tables:
        yield from _of_map(_by_seed(tables[DEFAULT], "map_length_1"))
        yield from _of_new_sequences(tables[DEFAULT])
        errors = _by_seed(tables[DEFAULT], "end_of_stage_1_cm")
        for name in (TD_MD, TD_MND, TND_MND):
            what = f"{TND_MD} − {name}, imitation error at the end of stage 1 [cm]"
            text = f"When stage 1 ends, {TND_MD} is farther off than {name}"
            yield PlannedTest(LEARNING, text, what, errors[TND_MD] - errors[name], name)
    if ORDER in tables:
        errors = _by_seed(tables[ORDER], "untrained_repertoire_cm")
        what = "error on untrained triples, from the repertoire [cm]"
        yield from _better(GENERALISATION, errors, "generalises better", what)


def _better(
    family: str, measure: pd.DataFrame, does: str, what: str, sign: int = 1
) -> Iterator[PlannedTest]:
    """Yield the tests of TD/MD against each other condition; `sign` −1 where more is better."""
    for name in OTHERS:
        differences = sign * (measure[name] - measure[TD_MD])
        pair = f"{name} − {TD_MD}" if sign > 0 else f"{TD_MD} − {name}"
        yield PlannedTest(
            family, f"{TD_MD} {does} than {name}", f"{pair}, {what}", differences, name
        )


def _of_map(lengths: pd.DataFrame) -> Iterator[PlannedTest]:
    what, over = "mean resultant length [1]", "over the Cs₀ map, with Cf₀ held"
    text = f"In {TD_MD} the direction is the same {over}"
    yield PlannedTest(MAP, text, f"{TD_MD} − {SAME}, {what}", lengths[TD_MD] - SAME, TD_MD)
    for name in OTHERS:
        text = f"In {name} the direction is not the same {over}"
        yield PlannedTest(MAP, text, f"{SAME} − {name}, {what}", SAME - lengths[name], name)


def _of_new_sequences(table: pd.DataFrame) -> Iterator[PlannedTest]:
    what = "error on untrained triples [cm]"
    e = _by_seed(table, "untrained_cm")
    teaching = ((e[TND_MD] + e[TND_MND]) - (e[TD_MD] + e[TD_MND])) / 2
    structuring = ((e[TD_MND] + e[TND_MND]) - (e[TD_MD] + e[TND_MD])) / 2
    crossed = ((e[TD_MND] + e[TND_MD]) - (e[TD_MD] + e[TND_MND])) / 2
    yield PlannedTest(NEW, "Teaching in phases (TD) helps", f"TND − TD, {what}", teaching)
    yield PlannedTest(NEW, "A growing network (MD) helps", f"MND − MD, {what}", structuring)
    text = "It helps when teaching and network match (interaction)"
    yield PlannedTest(NEW, text, f"mismatched − matched, {what}", crossed)
    yield from _better(NEW, e, "imitates untrained triples better", what)
    spread = _by_seed(table, "untrained_spread_cm")
    yield from _better(
        NEW, spread, "varies less over untrained triples", "spread over untrained triples [cm]"
    )


def _by_seed(table: pd.DataFrame, column: str) -> pd.DataFrame:
    """Return a measure with a row per seed and a column per condition, NaN where there is none."""
    wide = table.pivot(index="seed", columns="condition", values=column)
    return wide.reindex(columns=[TD_MD, *OTHERS]).astype(float)


def tested(tests: Sequence[PlannedTest]) -> list[Finding]:
    """Return what the seeds say to the tests of one family."""
    found = [_contrast(test) for test in tests]
    corrected = holm([each.p for each in found])
    return [
        Finding(
            test.family,
            test.text,
            test.measured,
            *each[:4],
            p,
            each.effect,
            each.seeds,
            len(test.differences) - each.seeds,
            verdict(each._replace(p=p), each.seeds),
            test.against,
        )
        for test, each, p in zip(tests, found, corrected, strict=True)
    ]


def _contrast(test: PlannedTest) -> Contrast:
    differences = test.differences.dropna().to_numpy(dtype=np.float64)
    try:
        return contrast(differences, test.measured)
    except TooFewSeedsError:
        value = float(differences.mean()) if len(differences) else nan
        return Contrast(value, nan, nan, nan, nan, len(differences))


def _together(
    text: str, values: "pd.Series[float]", least: float, parts: Sequence[Finding]
) -> Finding:
    """Return whether all parts hold, and TD/MD has at least so much of what they are about."""
    median = estimate(values.to_numpy(dtype=np.float64))
    seeds, said = median.seeds, {part.verdict for part in parts}
    reached = median.value >= least
    if "does not hold" in said or (seeds >= DECIDING and not reached):
        found = "does not hold"
    elif said == {"holds"} and reached:
        found = "holds"
    else:
        found = verdict(None, min([seeds, *(part.seeds for part in parts)]))
    weakest = max(parts, key=lambda part: (isnan(part.p_corrected), part.p_corrected))
    measured = f"{TD_MD}, median of {weakest.measured.split(', ')[1]}"
    p, corrected = weakest.p, weakest.p_corrected
    return Finding(
        parts[0].family, text, measured, *median[:3], p, corrected, weakest.effect, seeds,
        len(values) - seeds, found, main=True,
    )  # fmt: skip
