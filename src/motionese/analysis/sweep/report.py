"""The page of a sweep: findings by points, what the settings change, and the tables of both."""

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from urllib.parse import quote

import pandas as pd
from markupsafe import Markup
from matplotlib import rc_context

from motionese.analysis.beside_kept import TITLES
from motionese.analysis.cells import NONE, number, with_interval
from motionese.analysis.statistics import DECIDING, Estimate
from motionese.analysis.style import Look, looks_of
from motionese.analysis.sweep.effects import swept_effects
from motionese.analysis.sweep.figure import sweep_figure
from motionese.analysis.sweep.findings import swept_findings
from motionese.analysis.sweep.points import Points, points_of, reference_of
from motionese.analysis.templates import rendered
from motionese.errors import RunFolderError
from motionese.experiment.run_folder import REPORT
from motionese.experiment.sweeps import Sweep
from motionese.figure_style import SETTINGS, Drawing, finished
from motionese.files import write_whole

FINDINGS, EFFECTS, FIGURE = "sweep_findings.csv", "sweep_effects.csv", "sweep"

Cells = list[tuple[str, str, str]]
"""Of a row, a point each: a number with its interval, a verdict, and the verdict's kind."""
Rows = list[tuple[str, str, Cells]]
"""What is asked, what is said below it, and its cells."""


def write_sweep(sweep: Sweep, run_folders: Sequence[Path], path: Path) -> None:
    """Write the page of a sweep, with its tables and its figure beside it.

    Args:
        sweep: What was varied.
        run_folders: Those of its points that have a report.
        path: Where the page is written.

    Raises:
        RunFolderError: A folder has no report, or the page cannot be written.
    """
    points = points_of(sweep, run_folders)
    reference = reference_of(sweep, points)
    found = swept_findings(Path(sweep.preset).stem, points)
    changed = swept_effects(points, reference)
    try:
        for name, table in ((FINDINGS, found), (EFFECTS, changed)):
            write_whole(path.with_name(name), table.to_csv(index=False, lineterminator="\n"))
        drawing = None if changed.empty else _drawn(changed, points, reference)
        if drawing:
            file = path.parent / "figures" / FIGURE
            file.parent.mkdir(exist_ok=True)
            write_whole(file.with_suffix(".svg"), drawing.svg)
            write_whole(file.with_suffix(".png"), drawing.png)
        write_whole(path, sweep_page(sweep, points, reference, found, changed, drawing, path))
    except OSError as error:
        raise RunFolderError(
            f"{error.filename or path} cannot be written: {error.strerror}"
        ) from error


def sweep_page(
    sweep: Sweep,
    points: Points,
    reference: str,
    found: pd.DataFrame,
    changed: pd.DataFrame,
    drawing: Drawing | None,
    path: Path,
) -> str:
    """Return the page as HTML; `path` is where it will lie: links lead from there."""
    links = {
        label: quote(Path(os.path.relpath(each.folder / REPORT, path.parent)).as_posix())
        for label, each in points.items()
    }
    seeds = {label: len(each.seeds) for label, each in points.items()}
    return rendered(
        "sweep.html.jinja",
        title=sweep.title or f"A sweep over {', '.join(sweep.vary) or 'settings'}",
        name=path.parent.resolve().name,
        preset=sweep.preset,
        links=links,
        seeds=seeds,
        few=DECIDING if min(seeds.values()) < DECIDING else 0,
        missing=[point.label for point in sweep.points if point.label not in points],
        ends=[told for label, each in points.items() if (told := _ends(label, each.runs))],
        reference=reference,
        findings=findings_rows(found, list(points)),
        changes=effects_rows(changed, list(points), reference),
        figure=drawing and Markup(drawing.inline),
        tables=f"{FINDINGS} and {EFFECTS}",
    )


def findings_rows(found: pd.DataFrame, labels: Sequence[str]) -> Rows:
    """Return a row per finding: its text, what is measured, and a cell per point."""
    rows = []
    for (family, text), own in found.groupby(["family", "text"], sort=False):
        at, cells = _by_point(own), Cells()
        for label in labels:
            each = at.get(label)
            cells.append(_cell(each, each["statistic"], "") if each else (NONE, "", ""))
        rows.append((f"{family}: {text}", str(own["measured"].iloc[0]), cells))
    return rows


def effects_rows(changed: pd.DataFrame, labels: Sequence[str], reference: str) -> Rows:
    """Return a row per measure and condition: its difference in a cell per point."""
    rows = []
    for (measure, condition), own in changed.groupby(["measure", "condition"], sort=False):
        at = _by_point(own)
        cells = [
            (number(at[label]["median"]), "reference", "reference")
            if label == reference
            else _cell(at[label], at[label]["difference"], "difference_")
            for label in labels
        ]
        rows.append((TITLES.get(str(measure), str(measure)), str(condition), cells))
    return rows


def _by_point(own: pd.DataFrame) -> dict[Any, dict[Any, Any]]:
    return own.set_index("point").to_dict("index")


def _cell(row: Mapping[str, Any], value: float, ends: str) -> tuple[str, str, str]:
    interval = Estimate(value, row[f"{ends}low"], row[f"{ends}high"], row["seeds"])
    return with_interval(interval), row["verdict"], _kind(row["verdict"])


def _kind(verdict: str) -> str:
    return verdict.split(" with", maxsplit=1)[0].replace(" ", "-")


def _ends(label: str, runs: pd.DataFrame) -> str:
    """Say of a point which runs did not finish."""
    counts = runs["status"].value_counts()
    told = [f"{counts[s]} {s}" for s in ("diverged", "unfinished") if s in counts]
    return f"{label}: {' and '.join(told)} of {len(runs)} runs" if told else ""


def _drawn(changed: pd.DataFrame, points: Points, reference: str) -> Drawing:
    looks: dict[str, Look] = {}
    for each in points.values():
        looks |= looks_of(each.study.factors)
    present = set(changed["condition"])
    shown = {name: look for name, look in looks.items() if name in present}
    with rc_context(SETTINGS):
        return finished(sweep_figure(changed, list(points), reference, shown), FIGURE)
