"""The report: one page that shows what came of the runs, and the tables it was drawn from."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from motionese.analysis.claims import claims
from motionese.analysis.collected import Collected, collect
from motionese.analysis.directions import true_strokes
from motionese.analysis.figures import Shown, figures
from motionese.analysis.map_numbers import listed, map_numbers
from motionese.analysis.measures import Measures, measured
from motionese.analysis.page import page
from motionese.analysis.statistics import check_seeds
from motionese.analysis.verdicts import Judgement, claims_table, judge
from motionese.errors import RunFolderError, TooFewSeedsError
from motionese.experiment.conditions import Condition
from motionese.experiment.run_folder import REPORT
from motionese.files import write_whole


@dataclass(frozen=True)
class Report:
    """A report that was written.

    Attributes:
        path: The page.
        runs: How many ended runs it is about.
        too_few: Why tests could not be made for want of seeds, or "".
    """

    path: Path
    runs: int
    too_few: str


def write_report(run_folder: Path, told: Callable[[str], None] | None = None) -> Report:
    """Write `report.html`, the tables and the figures of a run folder into it.

    Runs that diverged or have not ended are listed, not tested; with too few seeds for a test
    everything else is written, and the report returned says so.

    Args:
        run_folder: The folder.
        told: Called with a line about each step.

    Raises:
        RunFolderError: There is no ended run in it, a file in it is damaged, or it cannot be
            written to.
        StorageError: How a run ended cannot be read.
    """
    tell = told or (lambda line: None)
    collected = collect(run_folder)
    ended = int((collected.runs["status"] != "unfinished").sum())
    tell(f"{ended} of {len(collected.runs)} runs have ended")
    settings = collected.facts.settings
    strokes = true_strokes(settings.caregiver)
    numbers = map_numbers(collected.slow_state_map, collected.development, strokes)
    measures = measured(collected.loops, collected.triples, numbers, settings.phases)
    results = [judge(claim) for claim in claims(measures)]
    try:
        _write_tables(collected, numbers, results)
        drawn = []
        for each in figures(collected, measures):
            tell(f"figure {each.name}")
            _write_figure(run_folder / "figures", each)
            drawn.append(each)
        too_few = _too_few(measures, collected.conditions)
        path = run_folder / REPORT
        write_whole(path, page(collected, measures, numbers, results, drawn, too_few))
    except OSError as error:
        raise RunFolderError(
            f"{error.filename or run_folder} cannot be written: {error.strerror}"
        ) from error
    tell(f"report {path}")
    return Report(path, ended, too_few)


def _write_tables(collected: Collected, numbers: pd.DataFrame, results: list[Judgement]) -> None:
    tables = {
        "loops": collected.loops,
        "development": collected.development,
        "triples": collected.triples,
        "slow_state_map": collected.slow_state_map,
        "map_numbers": numbers,
        "runs": collected.runs,
        "claims": claims_table(results),
    }
    for name, table in tables.items():
        text = table.to_csv(index=False, lineterminator="\n")
        write_whole(collected.folder / f"{name}.csv", text)


def _write_figure(folder: Path, shown: Shown) -> None:
    folder.mkdir(exist_ok=True)
    write_whole(folder / f"{shown.name}.svg", shown.drawing.svg)
    write_whole(folder / f"{shown.name}.png", shown.drawing.png)


def _too_few(measures: Measures, conditions: Sequence[Condition]) -> str:
    """Return why the conditions that were run cannot be tested, or ""."""
    names = [c.name for c in conditions]
    common = measures.last_error[names].dropna()
    try:
        check_seeds(len(common), f"with an ended run in {listed(names)}")
    except TooFewSeedsError as reason:
        return str(reason)
    return ""
