"""What a run folder that has been reported on says of its runs, seed by seed."""

from dataclasses import dataclass
from pathlib import Path
from typing import IO

import pandas as pd

from motionese.analysis.facts import read_facts
from motionese.errors import RunFolderError
from motionese.experiment import Study
from motionese.experiment.digests import changed, told

MEASURES, RUNS = "measures.csv", "runs.csv"
ENDS = ["condition", "seed", "loops", "seconds", "status", "reason"]


@dataclass(frozen=True)
class Reported:
    """The runs of a folder.

    Attributes:
        preset: The name of their preset; of a file, without its ending.
        version: That of motionese, which began them.
        runs: How every run ended, a row a run.
        measures: What was measured, a row per condition and seed.
    """

    folder: Path
    preset: str
    study: Study
    version: str
    runs: pd.DataFrame
    measures: pd.DataFrame

    @property
    def seeds(self) -> list[int]:
        """The seeds that were measured, in rising order."""
        return sorted({int(seed) for seed in self.measures["seed"]})


def read_reported(folder: Path) -> Reported:
    """Read what stands beside the report of a run folder.

    Raises:
        RunFolderError: It is no run folder, has no report of this version, or one that has changed.
    """
    facts = read_facts(folder)
    for table in changed(folder):
        if table.name in (MEASURES, RUNS):
            raise RunFolderError(f"{told(table)}; motionese report {folder} writes it again")
    preset = Path(str(facts.record.get("preset", ""))).stem
    version = str(facts.environment.get("motionese", ""))
    try:
        with (folder / RUNS).open() as file, (folder / MEASURES).open() as measures:
            runs = pd.read_csv(file)[ENDS]
            return Reported(folder, preset, facts.study, version, runs, read_measures(measures))
    except (OSError, ValueError, KeyError) as error:
        raise RunFolderError(
            f"{folder} has no whole report ({error}); motionese report {folder} writes it"
        ) from error


def read_measures(file: IO[str]) -> pd.DataFrame:
    """Return a table of measures: words for the condition, a whole seed, numbers for all else."""
    table = pd.read_csv(file)
    numbers = table.drop(columns=["condition", "seed"]).astype(float)
    return table[["condition", "seed"]].join(numbers)
