"""The results that come with the package: what was measured in the confirming runs, seed by seed.

`results/` holds a table a preset, with a row per condition and seed, and `runs.json`, which tells
what they were made with: settings, seeds, version. `make results` makes them again.
"""

import json
from collections.abc import Sequence
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Any, NamedTuple

import pandas as pd

from motionese.analysis.reported import Reported, read_measures, read_reported
from motionese.errors import RunFolderError
from motionese.files import write_whole

RESULTS: Traversable = resources.files("motionese.analysis") / "results"
RUNS = "runs.json"


class KeptRuns(NamedTuple):
    """What the kept runs of a preset were made with.

    Attributes:
        seeds: Their seeds, in rising order.
        version: That of motionese, which made them.
        settings: All settings, as in a run folder's `settings.json`.
    """

    seeds: list[int]
    version: str
    settings: dict[str, Any]


def kept_results() -> dict[str, pd.DataFrame]:
    """Return the measures of the kept runs by preset, a row per condition and seed.

    The dictionary is empty where none are kept.
    """
    tables = {}
    for preset in kept_runs():
        with (RESULTS / f"{preset}.csv").open(encoding="utf-8") as file:
            tables[preset] = read_measures(file)
    return tables


def kept_runs() -> dict[str, KeptRuns]:
    """Return what the kept runs were made with, by preset."""
    file = RESULTS / RUNS
    facts = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    return {preset: KeptRuns(**each) for preset, each in facts.items()}


def keep(run_folders: Sequence[Path], into: Path) -> None:
    """Keep the measures of run folders that have been reported on.

    Args:
        run_folders: A folder a preset, in which all runs have ended.
        into: The folder that the tables and `runs.json` are written to.

    Raises:
        RunFolderError: One has no report or a run that has not ended, or two are of one preset.
    """
    kept: dict[str, Reported] = {}
    for folder in run_folders:
        found = read_reported(folder)
        if found.preset in kept:
            raise RunFolderError(
                f"{folder} is of {found.preset}, as {kept[found.preset].folder} is"
            )
        if (found.runs["status"] == "unfinished").any():
            raise RunFolderError(f"{folder} holds runs that have not ended; go on with them")
        kept[found.preset] = found
    into.mkdir(parents=True, exist_ok=True)
    told = {}
    for preset, found in kept.items():
        text = found.measures.to_csv(index=False, lineterminator="\n", float_format="%.6g")
        write_whole(into / f"{preset}.csv", text)
        settings = found.study.model_dump(mode="json")
        told[preset] = KeptRuns(found.seeds, found.version, settings)._asdict()
    write_whole(into / RUNS, json.dumps(told, indent=1) + "\n")
