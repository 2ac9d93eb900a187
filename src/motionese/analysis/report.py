"""The report: one page that shows what came of the runs, and the tables it was drawn from."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from motionese.analysis.cells import listed
from motionese.analysis.changes import answers_the_learner, changes, further_measures
from motionese.analysis.effects import effects
from motionese.analysis.experiment_data import ROLES, collect
from motionese.analysis.figures import figures
from motionese.analysis.mochizuki2013 import (
    answer,
    claims,
    findings,
    findings_table,
    has_its_design,
    preset_of,
)
from motionese.analysis.page import page
from motionese.analysis.planned_changes import planned_findings
from motionese.analysis.roles import seed_table
from motionese.analysis.seed_measures import Measures, measured
from motionese.analysis.statistics import check_seeds
from motionese.analysis.verdicts import claims_table, judge
from motionese.errors import RunFolderError, TooFewSeedsError
from motionese.experiment import digests
from motionese.experiment.run_folder import ENVIRONMENT, REPORT, SETTINGS
from motionese.files import write_whole


@dataclass(frozen=True)
class Report:
    """The page that was written, and how many ended runs it is about.

    Attributes:
        too_few: Why tests could not be made for want of seeds, or "".
        unlike: Files of the report before that had changed since they were written.
    """

    path: Path
    runs: int
    too_few: str
    unlike: list[Path]


def write_report(run_folder: Path) -> Report:
    """Write `report.html`, the tables and the figures of a run folder into it.

    Runs that diverged or have not ended are listed, not tested; with too few seeds for a test
    everything else is written, and the report returned says so.

    Raises:
        RunFolderError: There is no ended run in it, a file in it is damaged, or it cannot be
            written to.
    """
    data = collect(run_folder)
    ended = int((data.runs["status"] != "unfinished").sum())
    study = data.study
    numbers, by_seed = data.map_numbers, seed_table(data)
    measures = measured(data, numbers)
    changed = changes(data.loops, data.development, study) if answers_the_learner(study) else None
    further = {} if changed is None else further_measures(study, by_seed, changed)
    found = effects(measures, study.factors, further)
    results = [judge(claim) for claim in claims(measures)] if has_its_design(study) else []
    planned = {preset: by_seed} if results and (preset := preset_of(study)) else {}
    tested, sentences = findings(planned), answer(planned)
    tested += planned_findings(study, by_seed, changed)
    tables = {"loops": data.loops, "development": data.development, **data.novel}
    tables |= {"slow_state_map": data.slow_state_map, "map_numbers": numbers}
    tables |= {"online": data.online, "switches": data.switches}
    tables |= {name: getattr(data, name) for name in ROLES} | {"measures": by_seed}
    tables |= {"runs": data.runs, "effects": found}
    tables |= {"changes": changed} if changed is not None else {}
    tables |= {"claims": claims_table(results)} if results else {}
    tables |= {"findings": findings_table(tested)} if tested else {}
    unlike = [file for file in digests.changed(run_folder) if file.exists()]
    written = [f"{name}.csv" for name in tables]
    try:
        digests.list_only(run_folder, [SETTINGS, ENVIRONMENT])
        for name, table in tables.items():
            text = table.to_csv(index=False, lineterminator="\n")
            write_whole(run_folder / f"{name}.csv", text)
        drawn = []
        (run_folder / "figures").mkdir(exist_ok=True)
        for each in figures(data, measures, by_seed, changed):
            write_whole(run_folder / "figures" / f"{each.name}.svg", each.drawing.svg)
            write_whole(run_folder / "figures" / f"{each.name}.png", each.drawing.png)
            written += [f"figures/{each.name}.svg", f"figures/{each.name}.png"]
            drawn.append(each)
        too_few = _too_few(measures, list(data.looks))
        path = run_folder / REPORT
        text = page(
            data, measures, by_seed, found, changed, results, tested, sentences, drawn, too_few
        )
        write_whole(path, text)
        digests.list_files(run_folder, [*written, REPORT])
    except OSError as error:
        raise RunFolderError(
            f"{error.filename or run_folder} cannot be written: {error.strerror}"
        ) from error
    return Report(path, ended, too_few, unlike)


def _too_few(measures: Measures, names: Sequence[str]) -> str:
    """Return why the conditions that were run cannot be tested, or ""."""
    common = measures.last_error[names].dropna()
    try:
        check_seeds(len(common), f"with an ended run in {listed(names)}")
    except TooFewSeedsError as reason:
        return str(reason)
    return ""
