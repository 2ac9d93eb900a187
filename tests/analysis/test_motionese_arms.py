"""The plan of the experiments on motionese, as it is tested."""

import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from motionese.analysis.motionese_arms import (
    _boundary_scores,
    _loops_until_reached,
    arm_findings,
    planned,
)
from motionese.errors import RunFolderError
from motionese.imitation.segments import Agreement

PLAN = (Path(__file__).parents[2] / "docs" / "plan_motionese.md").read_text()
ARMS = re.findall(r"--out runs/motionese/([a-z][\w-]*)", PLAN)
FAMILIES = dict(re.findall(r"^- \*\*(.+?)\*\* \((\w+) tests\)", PLAN, re.MULTILINE))
NUMBERS = {"four": 4, "six": 6, "eight": 8, "ten": 10}
MEASURES = ("order_by_cs", "separation", "untrained_cm", "newborn_cm", "newborn_residual_cm")
FURTHER = ("end_of_stage_2_cm", "pauses_recall", "right_elements")


def arms(**better):
    """All arms of the plan, alike but for noise, some of them better by so much in everything."""
    rng = np.random.default_rng(0)
    made = {}
    for arm in ARMS:
        gain = better.get(arm.replace("-", "_"), 0.0)
        table = pd.DataFrame(
            0.01 * rng.normal(size=(20, len(MEASURES + FURTHER))), columns=[*MEASURES, *FURTHER]
        )
        made[arm] = table + [-gain if name.endswith("_cm") else gain for name in table]
        made[arm].index = pd.RangeIndex(1100, 1120, name="seed")
    return made


def test_all_tests_of_the_plan_are_made_and_no_others():
    counts = pd.Series([test.family for test in planned(arms())]).value_counts()
    assert dict(counts) == {family: NUMBERS[number] for family, number in FAMILIES.items()}
    assert len(ARMS) == len(set(ARMS)) == 33


def test_what_is_better_holds_and_what_is_worse_does_not():
    found = arm_findings(arms(free_8=0.5, slowness=-0.5))
    verdicts = {each.text: each.verdict for each in found}
    assert verdicts["free-8 has more order_by_cs than free-0"] == "holds"
    assert verdicts["slowness has less untrained_cm than shared-0"] == "does not hold"
    assert verdicts["slowness has less newborn_cm than shared-0"] == "does not hold"
    alike = next(e for e in found if e.text == "free-2 has more order_by_cs than free-0")
    assert alike.p_corrected >= alike.p and abs(alike.statistic) < 0.02


def test_arms_that_are_not_there_are_left_out():
    some = {name: table for name, table in arms().items() if name.startswith("free-")}
    assert {test.family for test in planned(some)} == {
        *("Pauses", "What pauses cost", "Fading", "Attention"),
    }


def test_loops_until_2_cm_are_counted_in_the_stage():
    rows = [
        {"seed": seed, "loop": loop, "motion": motion, "imitation_error_cm": error + off}
        for seed, errors in {1: (3.0, 1.9, 2.5), 2: (4.0, 3.0, 2.0)}.items()
        for loop, error in enumerate(errors, start=16)
        for motion, off in (("UR ↓↑", 0.05), ("LR ↑←", -0.05))
    ]
    assert _loops_until_reached(pd.DataFrame(rows)).to_dict() == {1: 2.0, 2: 4.0}


def test_boundaries_are_pooled_over_demonstrations(tmp_path):
    with pytest.raises(RunFolderError, match=r"no run of it has boundaries\.csv"):
        _boundary_scores(tmp_path, "cf")
    for seed in (1, 2):
        rows = [
            {"condition": "TD/MD", "seed": seed, "source": source, "reference": reference}
            | {f"{n}_n": count for n, count in Agreement(*counts)._asdict().items()}
            | {"pauses_n": 1, "both_pauses_n": counts[0]}
            for source, reference, counts in (
                ("pauses", "", (1, 2, 1)),
                ("pauses", "", (0, 0, 1)),
                ("cf", "taught", (1, 1, 1)),
                ("cf", "alone", (0, 3, 1)),
                ("cf", "taught", (0, 1, 1)),
            )
        ]
        folder = tmp_path / "TD-MD" / f"seed-{seed}"
        folder.mkdir(parents=True)
        pd.DataFrame(rows).to_csv(folder / "boundaries.csv", index=False)
    scores = {name: series.to_dict() for name, series in _boundary_scores(tmp_path, "cf").items()}
    assert scores["pauses_recall"] == {1: 0.5, 2: 0.5} == scores["cf_recall"]
    assert scores["pauses_precision"] == {1: 0.5, 2: 0.5} == scores["cf_precision"]
