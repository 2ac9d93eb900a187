"""The experiments on motionese (docs/plan_motionese.md): arms of one condition, seed by seed.

An arm is a run folder of one condition, with its report. The plan was written before its runs were
made. Its tests are of paired differences over seeds, positive where they speak for the finding, and
corrected within each of its families.
"""

from collections.abc import Iterator, Mapping
from itertools import groupby
from pathlib import Path

import pandas as pd

from motionese.analysis.experiment_data import collect
from motionese.analysis.map_numbers import level_names
from motionese.analysis.mochizuki2013.findings import Finding, PlannedTest, tested
from motionese.analysis.reported import read_reported
from motionese.analysis.roles.role_shares import WHO
from motionese.errors import RunFolderError

NEWBORN = 3
"""A newborn's measures are means over so many first loops."""
REACHED_CM = 2.0
"""The imitation error that is to be reached in stage 2."""
BOUNDARIES = "boundaries.csv"

Arms = Mapping[str, pd.DataFrame]
"""Measures by the arm's name, a row per seed."""


def arm_table(folder: Path) -> pd.DataFrame:
    """Return the measures of an arm, a row per seed.

    Beside those of its report (`measures.csv`):

    - `newborn_cm`, `newborn_residual_cm`: imitation error and recognition residual, mean over the
      first three loops;
    - `loops_to_2_cm`: the first loop of stage 2, from 1, whose mean imitation error is below 2 cm;
      one more than the stage has where none is;
    - `pauses_recall`, `pauses_precision`, `cf_recall`, `cf_precision`: of boundaries, by pauses and
      as read in the level below the top one, against labels; `cf_pauses_recall` and
      `cf_pauses_precision` against pauses.

    Raises:
        RunFolderError: No report, several conditions, or a run without a table.
    """
    reported, data = read_reported(folder), collect(folder)
    conditions = set(reported.measures["condition"])
    if len(conditions) != 1:
        raise RunFolderError(f"{folder}: an arm is of one condition, got {len(conditions)}")
    early = data.loops[data.loops["loop"] <= NEWBORN].groupby("seed")
    found = {
        "newborn_cm": early["imitation_error_cm"].mean(),
        "newborn_residual_cm": early["recognition_residual_cm"].mean(),
        "loops_to_2_cm": _loops_until_reached(data.loops[data.loops["phase"] == 2]),
        **_boundary_scores(folder, level_names(data.study)[0]),
    }
    return reported.measures.set_index("seed").drop(columns="condition").assign(**found)


def planned(arms: Arms) -> Iterator[PlannedTest]:
    """Yield the tests of the plan whose arms there are, family by family."""
    order, separation = "order_by_cs", "separation"
    for arm in ("free-2", "free-4", "free-8", "free-12"):
        yield from _test("Pauses", arms, order, arm, "free-0")
    for arm in ("shared-2", "shared-4", "shared-8", "shared-12"):
        yield from _test("Pauses beside sharing", arms, separation, arm, "shared-0")
    for sharing in ("free", "shared"):
        calm, fading = f"{sharing}-8-adult", f"{sharing}-loops"
        yield from _test("What pauses cost", arms, "untrained_cm", calm, f"{sharing}-0")
        yield from _test("What pauses cost", arms, "untrained_cm", fading, calm)
    for arm in ("free-loops", "free-error"):
        for against in ("free-0", "free-8-adult"):
            yield from _test("Fading", arms, separation, arm, against)
    for arm in ("free-0", "free-8", "free-loops", "free-error", "shared-0"):
        without = "free-8-adult" if arm == "free-8" else arm
        yield from _test("Attention", arms, separation, f"{arm}-rests", without)
    yield from _test("Attention", arms, separation, "free-0-rests", "free-0-movement")
    shown = ("exaggeration", "slowness", "roundness", "repetition")
    for arm in shown:
        for measure in ("newborn_cm", "newborn_residual_cm"):
            yield from _test("A newborn", arms, measure, arm, "shared-0")
    for arm in (*shown, "slowness-fading"):
        for measure in ("end_of_stage_2_cm", "untrained_cm"):
            yield from _test("Later", arms, measure, arm, "shared-0")
    for measure in (separation, "untrained_cm"):
        yield from _test("Segments", arms, measure, "pauses-8", "shared-8")
    yield from _test("Segments", arms, "pauses_recall", "pauses-8", "pauses-0")
    yield from _test("Segments", arms, "right_elements", "pauses-8", "seen-8")


def arm_findings(arms: Arms) -> list[Finding]:
    """Return what the runs say to the tests of the plan whose arms there are."""
    families = groupby(planned(arms), lambda test: test.family)
    return [finding for _, tests in families for finding in tested(list(tests))]


def _test(family: str, arms: Arms, measure: str, arm: str, against: str) -> Iterator[PlannedTest]:
    """Yield the test that an arm is better than another: less of an error, more of a share."""
    if arm in arms and against in arms:
        less = measure.endswith("_cm")
        differences = arms[arm][measure] - arms[against][measure]
        text = f"{arm} has {'less' if less else 'more'} {measure} than {against}"
        pair = f"{against} − {arm}" if less else f"{arm} − {against}"
        signed = -differences if less else differences
        yield PlannedTest(family, text, f"{pair}, {measure}", signed.astype(float), against)


def _loops_until_reached(loops: pd.DataFrame) -> "pd.Series[float]":
    errors = loops.pivot_table(index="seed", columns="loop", values="imitation_error_cm")
    reached = errors < REACHED_CM
    first = reached.to_numpy().argmax(axis=1) + 1.0
    never = ~reached.any(axis=1)
    return pd.Series(first, index=errors.index).mask(never, errors.shape[1] + 1.0)


def _boundary_scores(folder: Path, below: str) -> dict[str, "pd.Series[float]"]:
    """Return recall and precision of boundaries by seed, pooled over demonstrations."""
    files = sorted(folder.glob(f"*/*/{BOUNDARIES}"))
    if not files:
        raise RunFolderError(f"{folder}: no run of it has {BOUNDARIES}")
    table = pd.concat([pd.read_csv(file, keep_default_na=False) for file in files])
    counts = [name for name in table.columns if name.endswith("_n")]
    pooled = table.groupby([WHO[1], "source", "reference"])[counts].sum()
    pauses = pooled.xs(("pauses", ""), level=("source", "reference"))
    read = pooled.xs((below, "taught"), level=("source", "reference"))
    return {
        "pauses_recall": pauses["both_n"] / pauses["true_n"],
        "pauses_precision": pauses["both_n"] / pauses["found_n"],
        "cf_recall": read["both_n"] / read["true_n"],
        "cf_precision": read["both_n"] / read["found_n"],
        "cf_pauses_recall": read["both_pauses_n"] / read["pauses_n"],
        "cf_pauses_precision": read["both_pauses_n"] / read["found_n"],
    }
