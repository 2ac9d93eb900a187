"""What a run folder holds: the tables of its runs put together, and how every run ended."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy import ndarray

from motionese.analysis.facts import Facts, read_facts
from motionese.analysis.run_files import read_end, read_inside, read_table
from motionese.errors import RunFolderError
from motionese.experiment.conditions import CONDITIONS, Condition
from motionese.experiment.run import Run

MEASURED = "imitation_error_cm recognition_residual_cm model_error_cm"
PRESSED = "buttons_due buttons_pressed"
LEADING_COLUMNS = {
    name: columns.split()
    for name, columns in {
        "loops": f"condition seed loop phase motion {MEASURED} reproduction_error_cm {PRESSED} "
        "status seconds",
        "development": "condition seed loop levels",
        "triples": f"condition seed motion trained {MEASURED} {PRESSED} status",
        "slow_state_map": "condition seed primitive cs_1 cs_2 direction_1_rad extent_1_rad "
        "direction_2_rad extent_2_rad",
    }.items()
}
"""Columns that every table has, in this order; further ones follow as the runs wrote them."""
EVALUATED = ("triples", "slow_state_map")
"""Tables of what is done after the last loop."""


@dataclass(frozen=True)
class Collected:
    """All ended runs of a folder.

    Rows are in the order of conditions, seeds, and then as the run wrote them, so that the same
    runs give the same tables, whenever and in whichever order they were made.

    Attributes:
        folder: The run folder.
        runs: A row per run: condition, seed, loops, seconds, status, reason.
        loops: A row per loop and motion.
        development: A row per loop on the network.
        triples: A row per new motion.
        slow_state_map: A row per primitive and point of the map.
        facts: Settings and environment.
    """

    folder: Path
    runs: pd.DataFrame
    loops: pd.DataFrame
    development: pd.DataFrame
    triples: pd.DataFrame
    slow_state_map: pd.DataFrame
    facts: Facts

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """The conditions that have an ended run."""
        present = set(self.loops["condition"])
        return tuple(c for c in CONDITIONS if c.name in present)

    def inside(self, condition: Condition, seed: int) -> dict[str, ndarray] | None:
        """Return what was kept of a run's performances, or None; `RunFolderError` if damaged."""
        path = self.folder / condition.folder / f"seed-{seed}" / "inside.npz"
        return read_inside(path) if path.is_file() else None


def collect(folder: Path) -> Collected:
    """Read a run folder.

    Raises:
        RunFolderError: There is no such folder, its settings are not of this version, it has no
            ended run, or a table of one is missing or damaged.
        StorageError: How a run ended cannot be read.
    """
    if not folder.is_dir():
        raise RunFolderError(f"{folder}: there is no such run folder")
    facts = read_facts(folder)
    runs = [(run, read_end(run)) for run in _runs(folder)]
    ended = [(run, end) for run, end in runs if end is not None]
    if not ended:
        raise RunFolderError(
            f"{folder}: no ended run in it; "
            + (f"{len(runs)} were begun" if runs else "runs lie in folders such as TD-MD/seed-100")
        )
    tables = {name: _together(name, ended) for name in LEADING_COLUMNS}
    how = pd.DataFrame([_how_it_ended(run, end) for run, end in runs])
    return Collected(folder=folder, runs=how, facts=facts, **tables)


def _runs(folder: Path) -> list[Run]:
    found = []
    for condition in CONDITIONS:
        numbered = [
            (int(path.name.removeprefix("seed-")), path)
            for path in (folder / condition.folder).glob("seed-*")
            if path.is_dir() and path.name.removeprefix("seed-").isdecimal()
        ]
        found += [Run(condition, seed, path) for seed, path in sorted(numbered)]
    return found


def _how_it_ended(run: Run, end: dict[str, Any] | None) -> dict[str, Any]:
    loops = len(list(run.folder.glob("loop-*.safetensors")))
    end = end or {"status": "unfinished", "reason": f"stopped after loop {loops}"}
    return {
        "condition": run.condition.name,
        "seed": run.seed,
        "loops": loops,
        "seconds": float(end.get("seconds", np.nan)),
        "status": end["status"],
        "reason": end.get("reason", ""),
    }


def _together(name: str, ended: list[tuple[Run, dict[str, Any]]]) -> pd.DataFrame:
    leading = LEADING_COLUMNS[name]
    read = [_table(run, end, name) for run, end in ended]
    if not any(len(table) for table in read):
        return pd.DataFrame(columns=leading)
    table = pd.concat([table for table in read if len(table)], ignore_index=True)
    others = [column for column in table.columns if column not in leading]
    return table.reindex(columns=[*leading, *others])


def _table(run: Run, end: dict[str, Any], name: str) -> pd.DataFrame:
    if end["status"] == "diverged" and name in EVALUATED:
        return pd.DataFrame()  # a diverged run is not evaluated
    rows = end.get("rows", {}).get(f"{name}.csv")
    # A network without a slow level has no map.
    empty = name == "slow_state_map"
    return read_table(run, name, LEADING_COLUMNS[name], rows, may_be_empty=empty)
