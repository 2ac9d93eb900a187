"""The report's page, made of its parts by one template; nothing in it is asked of the network."""

from collections.abc import Sequence
from itertools import groupby

import pandas as pd
from markupsafe import Markup

from motionese.analysis import mochizuki2013, page_tables
from motionese.analysis.changes import changes_table
from motionese.analysis.experiment_data import ROLES, ExperimentData
from motionese.analysis.facts import flat
from motionese.analysis.figures import Shown
from motionese.analysis.map_numbers import warnings
from motionese.analysis.mochizuki2013.findings import Finding
from motionese.analysis.roles.branching import without_cases
from motionese.analysis.roles.by_construction import by_construction
from motionese.analysis.roles.role_figures import last_lessons
from motionese.analysis.roles.role_shares import slow_followed
from motionese.analysis.roles.role_table import role_table
from motionese.analysis.seed_measures import LAST_LOOPS, Measures
from motionese.analysis.templates import rendered
from motionese.analysis.verdicts import Judgement, claims_table


def page(
    data: ExperimentData,
    measures: Measures,
    by_seed: pd.DataFrame,
    effects: pd.DataFrame,
    changed: pd.DataFrame | None,
    results: Sequence[Judgement],
    findings: Sequence[Finding],
    sentences: Sequence[str],
    figures: Sequence[Shown],
    too_few: str,
) -> str:
    """Return the page as HTML.

    `by_seed` has the measures of every run in one table, as of `seed_table`; `changed` when lesson
    and network changed, as of `changes`, where that answers the learner. A study of another
    design than the paper's has no `results`; one of other settings than those planned has no
    `findings`, and no `sentences` that answer the question from them. `too_few` is why tests could
    not be made, or "".
    """
    lessons = last_lessons(data).values()
    facts, warned = data.facts, warnings(data.map_numbers, data.study, slow_followed(by_seed))
    question, answer = f"What was learned of {data.task.title}?", [_last_errors(measures)]
    if results:
        question, answer = mochizuki2013.QUESTION, [*sentences]
        answer = answer or [mochizuki2013.answer_by_map(measures), *warned]
    departures = groupby(mochizuki2013.departures() if results else (), lambda d: d.heading)
    tables = ["loops", *data.novel, "online", "switches", "slow_state_map", "map_numbers"]
    tables += [*ROLES, "measures"]
    tables += ["development", "effects"] + ["changes"] * (changed is not None)
    tables += ["claims"] * bool(results) + ["findings"] * bool(findings) + ["runs"]
    shown: dict[str, list[tuple[str, str, Markup]]] = {}
    for f in figures:
        shown.setdefault(f.section, []).append((f.name, f.caption, Markup(f.drawing.inline)))
    return rendered(
        "report.html.jinja",
        name=data.folder.resolve().name,
        question=question,
        answer=answer,
        results=results,
        claims=page_tables.claims_rows(claims_table(results)),
        findings=page_tables.findings_rows(findings),
        planned=findings,
        converged=mochizuki2013.CONVERGED_CM,
        same=mochizuki2013.SAME,
        departures=[(heading, list(each)) for heading, each in departures],
        too_few=too_few,
        last_loops=LAST_LOOPS,
        effects=page_tables.effects_rows(effects),
        changes=None if changed is None else changes_table(changed, list(data.looks)),
        lessons=page_tables.lessons_table(data.study),
        errors=page_tables.errors_table(measures, data),
        online=page_tables.online_table(data),
        map=page_tables.map_table(data.map_numbers, data),
        warnings=warned,
        roles=role_table(by_seed, data.looks),
        without_cases=dict.fromkeys(s for each in lessons for s in without_cases(each)),
        by_construction=by_construction(data.study),
        success=page_tables.success_table(data),
        runs=page_tables.runs_table(data.runs),
        failures=page_tables.failures_table(data.runs),
        settings=list(flat(facts.study.model_dump(mode="json"))),
        record=list(flat(facts.record)),
        environment=list(flat(facts.environment)),
        tables=tables,
        figures=shown,
    )


def _last_errors(measures: Measures) -> str:
    last = measures.last_error.median().dropna().sort_values()
    told = ", ".join(f"{error:.1f} cm in {name}" for name, error in last.items())
    return f"Imitation error at the end of the last stage, median over seeds: {told or 'none'}."
