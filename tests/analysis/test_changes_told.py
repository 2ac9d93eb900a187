"""What the report tells of changes that answer the learner, on invented runs."""

import numpy as np
import pandas as pd
import pytest

from motionese.analysis.changes import (
    answers_the_learner,
    censored,
    changes,
    changes_table,
    further_measures,
)
from motionese.analysis.changes_figure import changes_figure
from motionese.analysis.planned_changes import planned_findings
from motionese.analysis.style import looks_of
from motionese.experiment import read_settings

ADAPTIVE = read_settings("adaptive")


def run(name, seed, loops):
    """Return the tables of a run: by loop its stage, its levels, and its errors by motion."""
    who = {"condition": name, "seed": seed}
    rows = [
        {**who, "loop": n, "phase": phase, "motion": motion, "imitation_error_cm": error}
        for n, (phase, _, errors) in enumerate(loops, 1)
        for motion, error in errors.items()
    ]
    grown = [
        {**who, "loop": n, "levels": levels, "emerged_cf": 0.1 * n}
        for n, (_, levels, _) in enumerate(loops, 1)
    ]
    return rows, grown


@pytest.fixture
def told():
    soon = [(1, 2, {"a": 9.0}), (2, 2, {"b": 1.0}), (2, 3, {"b": 1.0}), (2, 3, {"b": 1.0})]
    late = [(1, 2, {"a": 9.0}), (1, 2, {"a": 9.0}), (2, 2, {"b": 1.0}), (2, 2, {"b": 1.0})]
    runs = [run("TF/MF", 0, soon), run("TA/MA", 0, late)]
    loops, development = (pd.DataFrame([r for each in runs for r in each[i]]) for i in (0, 1))
    return changes(loops, development, ADAPTIVE)


def test_a_run_tells_when_it_changed_and_how_soon_it_had_mastered_the_lesson(told):
    soon, late = told.to_dict("records")
    assert (soon["stage_1_ends"], soon["cs_opens"], soon["loops_needed"]) == (1, 2, 4)
    assert (soon["loops"], soon["demonstrations"], soon["demonstrations_needed"]) == (4, 4, 4)
    assert soon["emerged_cf"] == pytest.approx(0.4)
    assert late["stage_1_ends"] == 2
    assert np.isnan(late["cs_opens"]) and np.isnan(late["loops_needed"])


def test_who_never_got_there_counts_with_one_loop_more(told):
    assert censored(told, "loops_needed", "loops").loc[0].to_dict() == {"TF/MF": 4, "TA/MA": 5}
    head, rows = changes_table(told, ["TF/MF", "TA/MA"])
    opens = head.index("Cs opens")
    assert [row[opens] for row in rows] == ["2", "–"]


def test_every_change_is_a_panel(told):
    figure = changes_figure(told, looks_of(ADAPTIVE.factors))
    titles = [axes.get_title() for axes in figure.axes]
    assert titles == ["Stage 1 ended", "Cs opened", "Last lesson mastered"]


def test_only_studies_that_answer_the_learner_tell_of_it():
    answering = ["adaptive", "scaffolding", "settled"]
    assert all(answers_the_learner(read_settings(name)) for name in answering)
    assert not any(answers_the_learner(read_settings(n)) for n in ("default", "order"))


def measures(values):
    """Return measures of twelve seeds in which conditions differ by so much, and little noise."""
    rng = np.random.default_rng(0)
    rows = [
        {"condition": name, "seed": seed, "separation": value + 0.01 * rng.standard_normal(),
         "end_of_stage_2_cm": 2 - value, "loops": 30, "loops_needed": 30 - 10 * value,
         "demonstrations": 100, "demonstrations_needed": 50.0}
        for name, value in values.items() for seed in range(12)
    ]  # fmt: skip
    return pd.DataFrame(rows)


def test_the_planned_tests_say_who_is_better_corrected_within_their_families():
    table = measures({"TF/MF": 0.2, "TF/MA": 0.6, "TA/MF": 0.2, "TA/MA": 0.6})
    found = planned_findings(ADAPTIVE, table, table)
    assert len(found) == 4 + 4 + 4 + 1
    verdicts = {(f.family, f.text): f.verdict for f in found}
    grows = "A network that grows when it is ready helps"
    assert {verdicts[f, grows] for f in ("Loops needed", "Final error", "Separation")} == {"holds"}
    waits = "A caregiver who waits until the learner is ready helps"
    assert verdicts["Separation", waits].startswith("undecided")
    assert [f.verdict for f in found if f.family == "Order of change"] == ["holds"]
    assert all(f.p_corrected >= f.p for f in found)
    assert further_measures(ADAPTIVE, table, table)["separation of the roles [1]"].shape == (12, 4)


def test_other_designs_have_other_tests_or_none():
    chosen = measures({"easiest": 0.5, "progress": 0.2, "random": 0.2})
    found = planned_findings(read_settings("scaffolding"), chosen, chosen)
    assert [f.verdict for f in found if "easiest" in f.text][-1] == "holds"
    assert planned_findings(read_settings("settled"), chosen, chosen) == []


def test_a_fourth_level_is_tested_though_nothing_answers_the_learner():
    deeper = measures({"M4": 0.2, "M3": 0.6})
    columns = {"end_of_stage_3_cm": deeper["loops_needed"], "untrained_cm": deeper["loops_needed"]}
    found = planned_findings(read_settings("four_levels"), deeper.assign(**columns), None)
    assert [f.family for f in found] == ["Fourth level"] * 2
