"""The report's page, made of its parts by one template; nothing in it is asked of the network."""

from collections.abc import Sequence
from importlib import resources
from itertools import groupby

import pandas as pd
from jinja2 import Environment, StrictUndefined
from markupsafe import Markup

from motionese import __version__
from motionese.analysis import page_tables, run_tables
from motionese.analysis.answer import QUESTION, answer, main_claims
from motionese.analysis.claims import CONVERGED_CM, SAME
from motionese.analysis.collected import Collected
from motionese.analysis.departures import departures
from motionese.analysis.facts import flat
from motionese.analysis.figures import Shown
from motionese.analysis.map_numbers import warnings
from motionese.analysis.measures import LAST_LOOPS, Measures
from motionese.analysis.verdicts import Judgement, claims_table


def page(
    collected: Collected,
    measures: Measures,
    numbers: pd.DataFrame,
    results: Sequence[Judgement],
    figures: Sequence[Shown],
    too_few: str,
) -> str:
    """Return the page as HTML.

    Args:
        collected: The runs.
        measures: What the claims are about.
        numbers: A row per condition and seed on its map.
        results: The judged claims.
        figures: The figures, in the order they are shown.
        too_few: Why tests could not be made, or "".
    """
    facts = collected.facts
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True,
                              lstrip_blocks=True)  # fmt: skip
    return environment.from_string(_part("report.html.jinja")).render(
        style=Markup(_part("report.css")),
        question=QUESTION,
        name=collected.folder.resolve().name,
        version=__version__,
        answer=answer(measures, numbers),
        main_claims=main_claims(results),
        too_few=too_few,
        claims=page_tables.claims_rows(claims_table(list(results))),
        main=[each.claim.main for each in results],
        definitions={"converged": CONVERGED_CM, "same": SAME, "loops": LAST_LOOPS},
        errors=page_tables.errors_table(measures, collected.triples),
        map=page_tables.map_table(numbers, collected.conditions),
        warnings=warnings(numbers),
        buttons=run_tables.buttons_table(collected),
        runs=run_tables.runs_table(collected.runs),
        failures=run_tables.failures_table(collected.runs),
        settings=list(flat(facts.settings.model_dump(mode="json"))),
        settings_told=facts.told,
        record=list(flat(facts.record)),
        environment=list(flat(facts.environment)),
        departures=[
            (heading, list(each)) for heading, each in groupby(departures(), lambda d: d.heading)
        ],
        figures={
            section: [(f.name, f.caption, Markup(f.drawing.inline)) for f in each]
            for section, each in _by_section(figures).items()
        },
    )


def _by_section(figures: Sequence[Shown]) -> dict[str, list[Shown]]:
    sections: dict[str, list[Shown]] = {}
    for each in figures:
        sections.setdefault(each.section, []).append(each)
    return sections


def _part(name: str) -> str:
    return resources.files("motionese.analysis").joinpath(name).read_text(encoding="utf-8")
