"""What a run folder holds: the tables of its runs put together, and how every run ended."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy import ndarray

from motionese.analysis.directions import true_strokes
from motionese.analysis.facts import Facts, read_facts
from motionese.analysis.map_numbers import map_numbers
from motionese.analysis.style import Look, looks_of
from motionese.body import SimulatedRobot, open_body
from motionese.errors import RunFolderError
from motionese.experiment import Run, Study, condition_named
from motionese.experiment.run import INSIDE, runs_in
from motionese.task import Task

MAP = "slow_state_map"
REPERTOIRE = ["imitation_error_cm", "recognition_residual_cm", "status"]
ROLES = {
    "exchanges": ["recognition", "motion_lower", "motion_upper", "demonstration", "split", "kind",
                  "stroke", "follows"],
    "lesions": ["motion", "demonstration", "lesion", "stroke", "ambiguous", "right"],
    "decoding": ["level", "what", "score", "chance"],
    "symbols": ["level", "reference", "motion", "demonstration", "read", "true", "edit_distance",
                "boundary_error_steps"],
}  # fmt: skip
"""Tables of what role each level plays."""
MEASURED = ["imitation_error_cm", "recognition_residual_cm", "model_error_cm"]


def leading_columns(study: Study) -> dict[str, list[str]]:
    """Return the columns that every table has, in this order; further ones follow as written."""
    task = study.task.task()
    of = dict.fromkeys(c for outcome in task.outcomes for c in (outcome.of, outcome.column) if c)
    who, top = ["condition", "seed"], list(study.network.levels)[-1]
    new = [*who, "motion", "trained", *MEASURED, *of, "status"]
    new += [f"repertoire_{name}" for name in REPERTOIRE]
    ways = [f"{what}_{segment}_rad" for segment in (1, 2) for what in ("direction", "extent")]
    loop = ["loop", "phase", "motion", *MEASURED]
    loop += ["reproduction_error_cm", "reproduction_strokes_cm"]
    return {
        "loops": [*who, *loop, *of, "status", "seconds"],
        "development": [*who, "loop", "levels"],
        **dict.fromkeys(task.novel, new),
        "online": [*who, "taught", "motion", "lag", MEASURED[0], "after_the_fact_error_cm"],
        "switches": [*who, "first", "second", "row", "steps"],
        MAP: [*who, "primitive", f"{top}_1", f"{top}_2", *ways],
        **{name: [*who, *columns] for name, columns in ROLES.items()},
    }


@dataclass(frozen=True)
class ExperimentData:
    """All ended runs of a folder.

    Rows are in the order of conditions, seeds, and then as the run wrote them, so that the same
    runs give the same tables, whenever and in whichever order they were made.

    Attributes:
        runs: A row per run: condition, seed, loops, seconds, status, reason.
        loops: A row per loop and motion.
        development: A row per loop on the network.
        novel: A row per new sequence, by the set's name.
        slow_state_map: A row per primitive and point of the map.
        online: A row per sequence and lag at which it was followed while it was shown.
        switches: A row per demonstration that turned into another.
        exchanges: A row per exchange of initial states between two motions: whose stroke follows.
        lesions: A row per lesion, demonstration and stroke.
        decoding: A row per level and what is decoded from it.
        symbols: A row per demonstration and what was read out of the network.
    """

    folder: Path
    runs: pd.DataFrame
    loops: pd.DataFrame
    development: pd.DataFrame
    novel: dict[str, pd.DataFrame]
    slow_state_map: pd.DataFrame
    online: pd.DataFrame
    switches: pd.DataFrame
    exchanges: pd.DataFrame
    lesions: pd.DataFrame
    decoding: pd.DataFrame
    symbols: pd.DataFrame
    facts: Facts

    @property
    def study(self) -> Study:
        """The settings of all runs."""
        return self.facts.study

    @property
    def task(self) -> Task:
        """The task of all runs."""
        return self.study.task.task()

    @property
    def new_sequences(self) -> pd.DataFrame:
        """The rows of all sets of new sequences."""
        filled = [table for table in self.novel.values() if len(table)]
        none = self.loops.iloc[:0].assign(trained=False)
        return pd.concat(filled or [none], ignore_index=True)

    @property
    def looks(self) -> dict[str, Look]:
        """The conditions that have an ended run, in order, and how each is drawn."""
        present, looks = set(self.loops["condition"]), looks_of(self.study.factors)
        return {name: look for name, look in looks.items() if name in present}

    @cached_property
    def robot(self) -> SimulatedRobot:
        """The robot of all runs: its channels, its model, where its eye is."""
        # Nothing is looked at: a machine that renders no pictures can read about those that do.
        unseeing = self.study.body.model_copy(update={"vision": "projection"})
        return open_body(unseeing, self.task)

    @property
    def strokes(self) -> Mapping[str, tuple[float, float]]:
        """Every primitive's direction [rad] and extent [rad] as the robot sees it."""
        return true_strokes(self.task, self.robot.eye_position)

    @cached_property
    def map_numbers(self) -> pd.DataFrame:
        """A row of numbers for each condition and seed that has a map."""
        return map_numbers(self.slow_state_map, self.development, self.study, self.strokes)

    def inside(self, condition: str, seed: int) -> dict[str, ndarray] | None:
        """Return what was kept of a run's performances; None of one that diverged."""
        of = condition_named(condition, self.study.factors)
        path = self.folder / of.folder / f"seed-{seed}" / INSIDE
        if not path.is_file():
            return None
        with np.load(path, allow_pickle=False) as kept:
            return dict(kept)


def collect(folder: Path) -> ExperimentData:
    """Read a run folder.

    Raises:
        RunFolderError: There is no such folder, its settings are not of this version, it has no
            ended run, or a file of one is missing or has changed since it was written.
    """
    if not folder.is_dir():
        raise RunFolderError(f"{folder}: there is no such run folder")
    facts = read_facts(folder)
    runs = []
    for run in runs_in(folder, facts.study):
        run.check()
        runs.append((run, run.ended()))
    ended = [(run, end) for run, end in runs if end is not None]
    if not ended:
        raise RunFolderError(
            f"{folder}: no ended run in it; "
            + (f"{len(runs)} were begun" if runs else "runs lie in folders such as TD-MD/seed-100")
        )
    columns = leading_columns(facts.study)
    tables = {name: _together(name, columns[name], ended) for name in columns}
    novel = {name: tables.pop(name) for name in facts.study.task.task().novel}
    how = pd.DataFrame([_how_it_ended(run, end) for run, end in runs])
    return ExperimentData(folder=folder, runs=how, facts=facts, novel=novel, **tables)


def _how_it_ended(run: Run, end: dict[str, Any] | None) -> dict[str, Any]:
    loops = run.loops_done()
    end = end or {"status": "unfinished", "reason": f"stopped after loop {loops}"}
    return {
        "condition": run.condition.name,
        "seed": run.seed,
        "loops": loops,
        "seconds": float(end.get("seconds", np.nan)),
        "status": end["status"],
        "reason": end.get("reason", ""),
    }


def _together(
    name: str, leading: list[str], ended: list[tuple[Run, dict[str, Any]]]
) -> pd.DataFrame:
    read = [_table(run, end, name) for run, end in ended]
    filled = [table for table in read if len(table)]
    if not filled:
        return pd.DataFrame(columns=leading)
    table = pd.concat(filled, ignore_index=True)
    others = [column for column in table.columns if column not in leading]
    return table.reindex(columns=[*leading, *others])


def _table(run: Run, end: dict[str, Any], name: str) -> pd.DataFrame:
    if end["status"] == "diverged" and name not in ("loops", "development"):
        return pd.DataFrame()
    try:
        return pd.read_csv(run.folder / f"{name}.csv")
    except pd.errors.EmptyDataError:  # e.g. no map, of a network without a slow level
        return pd.DataFrame()
