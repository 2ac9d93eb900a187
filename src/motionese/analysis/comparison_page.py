"""The page of several run folders: what is kept first, and these runs beside it."""

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import quote

import pandas as pd
from markupsafe import Markup

from motionese.analysis import mochizuki2013, page_tables
from motionese.analysis.beside_kept import SHOWN, TITLES, Beside
from motionese.analysis.cells import NONE, listed, number, with_interval
from motionese.analysis.kept import KeptRuns
from motionese.analysis.reported import Reported
from motionese.analysis.statistics import DECIDING
from motionese.analysis.templates import rendered
from motionese.experiment.presets import differences, study_of
from motionese.experiment.run_folder import REPORT
from motionese.figure_style import Drawing

ENDS = {"diverged": "diverged", "unfinished": "did not end"}
NO_ANSWER = "Runs of the presets order, default and free answer it; these have other settings."
TOLD = 6
"""Medians outside, and settings that differ, that are told one by one."""


class Series(NamedTuple):
    """The runs of a folder, and what is kept of their preset, if anything."""

    found: Reported
    name: str
    kept: pd.DataFrame | None
    kept_runs: KeptRuns | None
    beside: Sequence[Beside]


class Cell(NamedTuple):
    """What is kept of a measure in a condition, these runs' median, and where that lies."""

    kept: str
    own: str
    usual: str
    place: str


def comparison_page(
    series: Sequence[Series],
    drawn: Mapping[str, Drawing],
    kept: Mapping[str, pd.DataFrame],
    kept_runs: Mapping[str, KeptRuns],
    path: Path,
    table: str,
) -> str:
    """Return the page as HTML.

    Args:
        series: A run folder each.
        drawn: Figures by the series' names.
        kept: The kept measures by preset; empty where nothing is kept.
        kept_runs: What those runs were made with.
        path: Where the page will lie: links lead from there.
        table: The name of the table beside it.
    """
    own = {of: e.found.measures for e in series if (of := mochizuki2013.preset_of(e.found.study))}
    planned = mochizuki2013.findings(kept or own)
    runs = pd.concat([
        each.found.runs.assign(condition=f"{each.name}, " + each.found.runs["condition"])
        for each in series
    ])  # fmt: skip
    return rendered(
        "comparison.html.jinja",
        question=mochizuki2013.QUESTION,
        name=path.parent.resolve().name,
        whose=_whose(kept_runs),
        answer=mochizuki2013.answer(kept or own) or [NO_ANSWER],
        caution=_caution(series, kept),
        outside=[_outside(each) for each in series if each.kept is not None],
        series=[_section(n, e, drawn.get(e.name), path) for n, e in enumerate(series, start=1)],
        findings=page_tables.findings_rows(planned),
        planned=planned,
        of_which="here they are of the kept runs" if kept else "here they are of your runs",
        same=mochizuki2013.SAME,
        runs=page_tables.runs_table(runs),
        failures=page_tables.failures_table(runs),
        beside=table,
    )


def _whose(kept_runs: Mapping[str, KeptRuns]) -> str:
    """Say whose answer it is."""
    told = [f"{preset} with {_seeds(runs.seeds)}" for preset, runs in kept_runs.items()]
    if not told:
        return "What these runs say; none are kept in this version of motionese"
    versions = listed(sorted({runs.version for runs in kept_runs.values()}))
    return f"What the kept runs say: {listed(told)}, made once with motionese {versions}"


def _caution(series: Sequence[Series], kept: Mapping[str, pd.DataFrame]) -> str:
    told = listed([f"{each.name} with {_seeds(each.found.seeds)}" for each in series])
    few = min(len(each.found.seeds) for each in series) < DECIDING
    words = f"Your own runs: {told}. "
    words += f"Fewer than {DECIDING} seeds decide nothing. " if few else ""
    if not kept:
        return f"{words}Nothing stands beside them: what is said above is of them alone."
    return (
        f"{words}They stand beside the kept ones below; a median of yours is told to be outside "
        "where it lies beyond the central 95 % of single kept seeds."
    )


def _outside(series: Series) -> str:
    """Say which medians lie outside."""
    placed = [each for each in series.beside if each.place]
    outside = [
        f"{TITLES[each.measure]}, {each.condition} ({number(each.median)}; usual {_usual(each)})"
        for each in placed
        if each.place == "outside"
    ]
    if not outside:
        return f"{series.name}: all {len(placed)} medians lie inside."
    return f"{series.name}: {len(outside)} of {len(placed)} medians lie outside: {_few(outside)}."


def _section(count: int, series: Series, drawing: Drawing | None, path: Path) -> dict[str, Any]:
    """Return what the page says of the runs of a folder."""
    found, beside = series.found, series.beside
    conditions = list(dict.fromkeys(each.condition for each in beside))
    return {
        "name": series.name,
        "anchor": f"runs-{count}",
        "link": quote(Path(os.path.relpath(found.folder / REPORT, path.parent)).as_posix()),
        "what": f"Preset {found.preset}, {_seeds(found.seeds)}.",
        "warnings": list(_warnings(series)),
        "figure": drawing and Markup(drawing.inline),
        "kept": series.kept is not None,
        "conditions": conditions,
        "groups": list(groups(beside, conditions)),
    }


def _warnings(series: Series) -> Iterator[str]:
    found, before = series.found, series.kept_runs
    if before is None:
        yield f"Nothing is kept of preset {found.preset}: these runs stand alone."
    # What was no setting yet when they were made had its effect left out, as it has by default.
    elif changes := differences(
        study_of(before.settings).model_dump(mode="json"), found.study.model_dump(mode="json")
    ):
        yield f"These runs have other settings than the kept ones (kept → yours): {_few(changes)}."
    ends = found.runs["status"].value_counts()
    told = [f"{ends[status]} {words}" for status, words in ENDS.items() if status in ends]
    if told:
        yield f"Of these {len(found.runs)} runs {listed(told)}; see Runs."


def groups(
    beside: Sequence[Beside], conditions: Sequence[str]
) -> Iterator[tuple[str, list[tuple[str, list[Cell]]]]]:
    """Yield the table's groups of rows by their headings; what was nowhere measured is left out."""
    found = {(each.measure, each.condition): each for each in beside}
    measured = {measure for measure, _ in found}
    for heading, columns in SHOWN.items():
        shown = [
            (TITLES[column], [_cell(found.get((column, condition))) for condition in conditions])
            for column in columns
            if column in measured
        ]
        if shown:
            yield heading, shown


def _cell(beside: Beside | None) -> Cell:
    if beside is None:
        return Cell("", NONE, "", "")
    kept = with_interval(beside.kept) if beside.kept.seeds else ""
    return Cell(kept, number(beside.median), _usual(beside), beside.place)


def _usual(beside: Beside) -> str:
    return "–".join(map(number, beside.usual))


def _seeds(seeds: Sequence[int]) -> str:
    """Return how many seeds, and which."""
    if len(seeds) < 2:
        return f"seed {seeds[0]}" if seeds else "no seed"
    whole = len(seeds) == seeds[-1] - seeds[0] + 1
    which = f"{seeds[0]}–{seeds[-1]}" if whole else ", ".join(map(str, seeds))
    return f"{len(seeds)} seeds ({which})"


def _few(told: Sequence[str]) -> str:
    more = [f"and {len(told) - TOLD} more"] if len(told) > TOLD else []
    return "; ".join([*told[:TOLD], *more])
