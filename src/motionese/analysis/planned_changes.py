"""What was planned to be tested of change that answers the learner (docs/plan_adaptive.md)."""

from collections.abc import Iterator
from itertools import groupby

import pandas as pd

from motionese.analysis.changes import DEMONSTRATIONS, NEEDED, censored
from motionese.analysis.mochizuki2013.findings import Finding, PlannedTest, tested
from motionese.experiment import Study

FIXED, LEARNER, CAREGIVER, BOTH = "TF/MF", "TF/MA", "TA/MF", "TA/MA"
TWO_BY_TWO = [FIXED, LEARNER, CAREGIVER, BOTH]
CHOOSING, DEPTH = ["easiest", "progress", "random"], ["M4", "M3"]


def planned_findings(
    study: Study, by_seed: pd.DataFrame, changed: pd.DataFrame | None
) -> list[Finding]:
    """Return what runs say to the tests of the plan, if they are of one of its designs.

    Args:
        study: The settings of the runs.
        by_seed: Their measures, as of `seed_table`.
        changed: When lesson and network changed, as of `changes`; None where nothing answers.
    """
    last = f"end_of_stage_{len(study.stages)}_cm"

    def wide(column: str) -> pd.DataFrame:
        table = by_seed.pivot(index="seed", columns="condition", values=column)
        return table.reindex(columns=[c.name for c in study.conditions]).astype(float)

    names, tests = [c.name for c in study.conditions], list[PlannedTest]()
    if changed is not None and names == TWO_BY_TWO:
        needed = censored(changed, NEEDED, "loops").reindex(columns=names)
        tests += _crossed("Loops needed", "loops until the last lesson is mastered", needed)
        tests += _crossed("Final error", "error at the end [cm]", wide(last))
        separation = wide("separation")
        tests += _crossed("Separation", "separation [1]", separation, sign=-1)
        order = separation[LEARNER] - separation[CAREGIVER]
        text = "Roles separate more if the network changes before the lesson does"
        measured = f"{LEARNER} − {CAREGIVER}, separation [1]"
        tests.append(PlannedTest("Order of change", text, measured, order))
    elif changed is not None and names == CHOOSING:
        needed = censored(changed, DEMONSTRATIONS, "demonstrations").reindex(columns=names)
        tests += _chosen("Demonstrations needed", "demonstrations until mastered", needed)
        tests += _chosen("Final error", "error at the end [cm]", wide(last))
    elif names == DEPTH:
        for column, what in ((last, "error at the end"), ("untrained_cm", "untrained sequences")):
            table = wide(column)
            text, measured = "A fourth level helps", f"M3 − M4, {what} [cm]"
            tests.append(PlannedTest("Fourth level", text, measured, table["M3"] - table["M4"]))
    families = groupby(tests, lambda test: test.family)
    return [finding for _, family in families for finding in tested(list(family))]


def _crossed(family: str, what: str, measure: pd.DataFrame, sign: int = 1) -> Iterator[PlannedTest]:
    """Yield main effects, interaction, and both against neither; `sign` −1 where more is better."""
    fixed, learner, caregiver, both = (sign * measure[name] for name in TWO_BY_TWO)
    pairs = {
        "A caregiver who waits until the learner is ready helps": (
            "TF − TA" if sign > 0 else "TA − TF",
            (fixed + learner - caregiver - both) / 2,
        ),
        "A network that grows when it is ready helps": (
            "MF − MA" if sign > 0 else "MA − MF",
            (fixed + caregiver - learner - both) / 2,
        ),
        "It helps more if both answer (interaction)": (
            "one − both or neither" if sign > 0 else "both or neither − one",
            (learner + caregiver - fixed - both) / 2,
        ),
        f"{BOTH} is better than {FIXED}": (
            f"{FIXED} − {BOTH}" if sign > 0 else f"{BOTH} − {FIXED}",
            fixed - both,
        ),
    }
    for text, (pair, differences) in pairs.items():
        yield PlannedTest(family, text, f"{pair}, {what}", differences)


def _chosen(family: str, what: str, measure: pd.DataFrame) -> Iterator[PlannedTest]:
    for name, shown in (("easiest", "the easiest motions"), ("progress", "those that change most")):
        differences = measure["random"] - measure[name]
        text = f"Showing {shown} is better than a random choice"
        yield PlannedTest(family, text, f"random − {name}, {what}", differences)
