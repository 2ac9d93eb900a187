"""One report for several run folders: the answer of the kept runs, and these beside them."""

from collections.abc import Sequence
from pathlib import Path

import pandas as pd
from matplotlib import rc_context

from motionese.analysis.beside_figure import beside_figure
from motionese.analysis.beside_kept import beside_kept, beside_table
from motionese.analysis.comparison_page import Series, comparison_page
from motionese.analysis.kept import kept_results, kept_runs
from motionese.analysis.reported import Reported, read_reported
from motionese.analysis.style import looks_of
from motionese.errors import RunFolderError
from motionese.figure_style import SETTINGS, Drawing, finished
from motionese.files import write_whole

BESIDE = "beside_kept.csv"


def write_comparison(run_folders: Sequence[Path], path: Path) -> None:
    """Write one report for run folders that have one each, with its table and figures beside it.

    What is kept of a preset stands beside the runs of that preset. Without anything kept the page
    is made of these runs alone, and says so.

    Raises:
        RunFolderError: A folder has no report, or it cannot be written.
    """
    found = [read_reported(folder) for folder in run_folders]
    tables, runs = kept_results(), kept_runs()
    series = [
        Series(
            each,
            name,
            tables.get(each.preset),
            runs.get(each.preset),
            beside_kept(tables.get(each.preset), each.measures),
        )
        for each, name in zip(found, _names(found), strict=True)
    ]
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        (path.parent / "figures").mkdir(exist_ok=True)
        together = pd.concat([beside_table(e.beside).assign(runs=e.name) for e in series])
        columns = ["runs", *together.columns.drop("runs")]
        text = together[columns].to_csv(index=False, lineterminator="\n")
        write_whole(path.with_name(BESIDE), text)
        drawn = {}
        for number, each in enumerate(series, start=1):
            if each.beside:
                drawing = drawn[each.name] = _drawn(each, f"beside_kept_{number}")
                file = path.parent / "figures" / f"beside_kept_{number}"
                write_whole(file.with_suffix(".svg"), drawing.svg)
                write_whole(file.with_suffix(".png"), drawing.png)
        write_whole(path, comparison_page(series, drawn, tables, runs, path, BESIDE))
    except OSError as error:
        raise RunFolderError(
            f"{error.filename or path} cannot be written: {error.strerror}"
        ) from error


def _drawn(series: Series, name: str) -> Drawing:
    present = {each.condition for each in series.beside}
    looks = looks_of(series.found.study.factors)
    with rc_context(SETTINGS):
        shown = {name: look for name, look in looks.items() if name in present}
        return finished(beside_figure(series.beside, series.found.measures, shown), name)


def _names(found: Sequence[Reported]) -> list[str]:
    """Return what folders are called on the page: by their last part if that tells them apart."""
    names = [each.folder.resolve().name for each in found]
    return names if len(set(names)) == len(names) else [str(each.folder) for each in found]
