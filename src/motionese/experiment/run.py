"""One run, a condition with a seed: babbling, the loops of all stages, evaluation.

A run is a function of settings, condition and seed. It writes a checkpoint after every loop; one
that was stopped, or killed, goes on from its last whole loop and ends with the same bits. Its
folder lists the digests of its files.
"""

import csv
import hashlib
import io
import json
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

import numpy as np

from motionese.errors import RunFolderError, StorageError
from motionese.experiment.checkpoint import (
    Checkpoint,
    checkpoint_path,
    checkpoints_in,
    read_checkpoints,
    write_checkpoint,
)
from motionese.experiment.conditions import Condition
from motionese.experiment.digests import changed, list_files, listed, told
from motionese.experiment.study import Study
from motionese.files import write_whole
from motionese.imitation import (
    Development,
    Learner,
    LoopDone,
    Recordings,
    Row,
    Scene,
    Stage,
    babbled,
    followed,
    generator_for,
    imitate,
    imitate_novel,
    imitation_loop,
    kept_of,
    key_for,
    map_slow_states,
    network_row,
    newborn,
    role_tables,
    share_emerged,
    switched,
)

ENDED, INSIDE = "ended.json", "inside.npz"
EMERGED = "emerged_"
"""Columns of `development.csv` begin so that tell how much has emerged in a level."""
Listed = TypeVar("Listed")
AGAIN = "the same `motionese reproduce` command writes the tables again from the checkpoints"


@dataclass(frozen=True)
class Run:
    """A condition with a seed, and the folder it is kept in.

    `shown` is a digest of recorded demonstrations; empty for the scripted caregiver.
    """

    condition: Condition
    seed: int
    folder: Path
    shown: str = ""

    @property
    def name(self) -> str:
        """How people are told of it, such as 'TD/MD seed 100'."""
        return f"{self.condition.name} seed {self.seed}"

    def origin(self, settings: Study) -> str:
        """Return what its checkpoints are marked with: the run, and a digest of its settings."""
        text = json.dumps(settings.model_dump(mode="json"), sort_keys=True)
        shown = f", demonstrations {self.shown}" if self.shown else ""
        return f"{self.name}, settings {hashlib.sha256(text.encode()).hexdigest()[:12]}{shown}"

    def loops_done(self) -> int:
        """Return the number of its last whole loop, 0 before the first."""
        return len(self._listed(checkpoints_in))

    def ended(self) -> Row | None:
        """Return how the run ended (`status`, `reason`, `seconds`), or None while it has not.

        Raises:
            RunFolderError: The list of its files has changed.
            StorageError: The file that tells it cannot be read.
        """
        path = self.folder / ENDED
        if not path.is_file() or ENDED not in self._listed(listed):
            return None
        try:
            return dict(json.loads(path.read_text()))
        except (OSError, ValueError, TypeError, RecursionError) as error:
            raise StorageError(f"{path} cannot be read: remove it, and {AGAIN}") from error

    def check(self) -> None:
        """Check that its files are what was written.

        Checkpoints may be missing, and tables too while the run has not ended.

        Raises:
            RunFolderError: One has changed; the text says how it is made again.
        """
        found, checkpoints = self._listed(changed), self._listed(checkpoints_in)
        ended = (self.folder / ENDED).exists()
        found = [
            path
            for path in found
            if path in checkpoints or (ended and path.suffix != checkpoint_path(path, 1).suffix)
        ]
        if found:
            removed = "it" if found[0].name == ENDED else f"{ENDED} beside it"
            what = f"remove {removed}, and {AGAIN}"
            if found[0] in checkpoints:
                what = (
                    f"remove it, the checkpoints of later loops and {ENDED}, and the same "
                    "`motionese reproduce` command repeats these loops"
                )
            raise RunFolderError(f"{told(found[0])}: {what}")

    def _listed(self, read: Callable[[Path], Listed]) -> Listed:
        """Return what is read by the list of its files."""
        try:
            return read(self.folder)
        except StorageError as error:
            raise RunFolderError(
                f"{error}: remove {self.folder}, and the same `motionese reproduce` command makes "
                "the run again"
            ) from error


def runs_in(folder: Path, settings: Study, shown: str = "") -> list[Run]:
    """Return the runs that lie in a run folder, in the order of conditions and seeds."""
    return [
        Run(condition, seed, path, shown)
        for condition in settings.conditions
        for seed, path in sorted(
            (int(path.name.removeprefix("seed-")), path)
            for path in (folder / condition.folder).glob("seed-*")
            if path.is_dir() and path.name.removeprefix("seed-").isdecimal()
        )
    ]


def go_through(
    run: Run,
    settings: Study,
    loop_done: Callable[[int], None],
    recordings: Recordings | None = None,
) -> Row:
    """Do what is left of a run, and return how it ended.

    Args:
        loop_done: Called after every loop with its number.
        recordings: Demonstrations that are shown in the place of scripted ones.

    Raises:
        RunFolderError: One of its files has changed since it was written.
        StorageError: A checkpoint that is missing, or of another run or other settings.
    """
    run.check()
    ended = run.ended()
    if ended:
        return ended
    run.folder.mkdir(parents=True, exist_ok=True)
    scene = Scene(settings, run.seed, recordings)
    origin = run.origin(settings)
    course = _Course(origin, scene, settings.course(run.condition), settings.emerging)
    loops = read_checkpoints(run.folder, origin)
    while not (loops and loops[-1].failure):
        done = [_loop_done(checkpoint) for checkpoint in loops]
        stage = course.development.next_stage(done)
        if stage is None:
            break
        loops.append(_loop(course, stage, done, loops[-1] if loops else None))
        write_checkpoint(run.folder, loops[-1], scene.body.rate_hz)
        list_files(run.folder, [checkpoint_path(run.folder, loops[-1].loop).name])
        loop_done(loops[-1].loop)
    return _finish(run, scene, course.development.stages, loops)


@dataclass(frozen=True)
class _Course:
    """What a run goes through, the mark of its checkpoints, and what is looked at on the way."""

    origin: str
    scene: Scene
    development: Development
    emerging: tuple[str, ...]


def _loop_done(checkpoint: Checkpoint) -> LoopDone:
    rows, network = checkpoint.rows, checkpoint.development
    return LoopDone(
        stage=rows[0]["phase"] - 1,
        errors={row["motion"]: row["imitation_error_cm"] for row in rows},
        levels=network["levels"],
        emerged={
            name.removeprefix(EMERGED): share
            for name, share in network.items()
            if name.startswith(EMERGED)
        },
    )


def _loop(
    course: _Course, number: int, done: Sequence[LoopDone], before: Checkpoint | None
) -> Checkpoint:
    """Go through the next loop, which belongs to a stage (from 0)."""
    began = time.perf_counter()
    scene, stages = course.scene, course.development.stages
    stage, loop = _as_shown(stages, number, done), len(done) + 1
    levels = course.development.next_levels(number, done)
    learner = before.learner if before else babbled(scene, newborn(scene, levels))
    while len(learner.network.levels) < levels:
        # The network's own key: a level that opens late gets the weights, times the influence,
        # that the same seed gives it in a network that has it from the start.
        learner = learner.grown(scene.settings.network, key_for(scene.seed, "network"))
    opened = {f"{k}_at_opening": v for k, v in network_row(learner).items() if k.startswith("rms")}
    known = {k: v for k, v in before.development.items() if k in opened} if before else {}
    acting = scene.settings.imitation
    rehearsed = {s.name for each in stages[:number] for s in each.lesson if acting.rehearsal}
    if stage.choosing.shown:  # what is not chosen is not forgotten
        rehearsed |= {sequence.name for sequence in stage.lesson}
    memory = acting.memory * max(len(each.lesson) for each in stages)
    rng = generator_for(scene.seed, "choice", loop)
    shown = replace(stage, lesson=stage.choosing.chosen(stage.lesson, done, rng))
    learner, rows, grown, status = imitation_loop(scene, learner, shown, loop, memory, rehearsed)
    return Checkpoint(
        origin=course.origin,
        loop=loop,
        learner=learner,
        rows=[{"loop": loop, "phase": number + 1, **row} for row in rows],
        development={**grown, **opened, **known, **_emerged(course, learner, stage, loop)},
        failure=f"loop {loop}: {status}" if status.failed else "",
        seconds=(before.seconds if before else 0.0) + time.perf_counter() - began,
    )


def _as_shown(stages: Sequence[Stage], number: int, done: Sequence[LoopDone]) -> Stage:
    """Return a stage (from 0) as it is shown in the next loop, after what those done have told."""
    now = done[-1].error_cm if done and done[-1].stage == number else None
    return stages[number].at(len(done) + 1, now)


def _emerged(course: _Course, learner: Learner, stage: Stage, loop: int) -> Row:
    """Return by open level that any change waits for how much has emerged in it."""
    return {
        f"{EMERGED}{level}": share_emerged(course.scene, learner, stage.lesson, level, loop)
        for level in course.emerging
        if level in learner.network.names
    }


def _finish(run: Run, scene: Scene, stages: tuple[Stage, ...], loops: list[Checkpoint]) -> Row:
    """Write the run's tables; evaluate it if it did not fail."""
    began = time.perf_counter()
    last = loops[-1]
    tables = {
        "loops.csv": [row for checkpoint in loops for row in checkpoint.rows],
        "development.csv": [checkpoint.development for checkpoint in loops],
    }
    if not last.failure:
        if scene.settings.evaluation.motionese:
            done = [_loop_done(checkpoint) for checkpoint in loops]
            at_last = _as_shown(stages, len(stages) - 1, done)
            scene = scene.shown_with(at_last.manner.motionese)
        kept = _evaluated(scene, stages, last.learner, tables)
        content = io.BytesIO()
        np.savez_compressed(content, allow_pickle=False, **kept)
        write_whole(run.folder / INSIDE, content.getvalue())
    who = {"condition": run.condition.name, "seed": run.seed}
    for name, rows in tables.items():
        write_table(run.folder / name, [{**who, **row} for row in rows])
    ended = {
        "status": "diverged" if last.failure else "finished",
        "reason": last.failure,
        "seconds": round(last.seconds + time.perf_counter() - began, 2),
    }
    write_whole(run.folder / ENDED, json.dumps(ended, indent=1))
    inside = [] if last.failure else [INSIDE]
    list_files(run.folder, [*tables, *inside, ENDED])
    return ended


def _evaluated(
    scene: Scene, stages: tuple[Stage, ...], learner: Learner, tables: dict[str, list[Row]]
) -> dict[str, np.ndarray]:
    """Add what a learner can do to a run's tables; return what is kept of its performances."""
    taught = [sequence for stage in stages for sequence in stage.lesson]
    settings, lesson = scene.settings, stages[-1].lesson
    kept: dict[str, np.ndarray] = {}
    shown = {True: imitate(scene, learner, lesson, settings.recognition, "online")}
    for name in scene.task.novel:
        novel = scene.task.lesson(name)
        tables[f"{name}.csv"], imitated = imitate_novel(scene, learner, novel, taught)
        kept |= kept_of(scene.task, imitated)
        new = [each for each in imitated if each.sequence not in taught]
        shown[False] = [*shown.get(False, []), *new]
    tables["slow_state_map.csv"] = map_slow_states(scene, learner)
    tables |= role_tables(scene, learner, lesson)
    tables["online.csv"] = [
        {"taught": known, **row}
        for known, imitated in shown.items()
        for row in followed(scene, learner, imitated)
    ]
    known = {experience.motion for experience in learner.experiences}  # what was chosen to be shown
    turns = [sequence for sequence in lesson if sequence.name in known]
    switches = switched(scene, learner, turns, settings.evaluation.online.switches)
    tables["switches.csv"] = [each.measures() for each in switches]
    return kept | (switches[0].kept() if switches else {})


def write_table(path: Path, rows: Sequence[Row]) -> None:
    """Write rows as CSV; the columns are those of all rows, in the order they first appear."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    write_whole(path, text.getvalue())
