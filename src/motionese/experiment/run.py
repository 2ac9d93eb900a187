"""One run, a condition with a seed: babbling, the imitation loops of both phases, evaluation.

A run is a function of settings, condition and seed. It writes a checkpoint after every loop; one
that was stopped, or killed, goes on from its last whole loop and ends with the same bits.
"""

import hashlib
import io
import json
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from motionese.caregiver import Caregiver
from motionese.errors import StorageError
from motionese.experiment.checkpoint import (
    Checkpoint,
    checkpoint_path,
    latest_checkpoint,
    read_checkpoint,
    write_checkpoint,
)
from motionese.experiment.conditions import Condition
from motionese.experiment.evaluation import imitate_new_motions, inside, map_slow_states
from motionese.experiment.imitation_loop import Row, development, for_levels, imitation_loop
from motionese.experiment.keys import key_for
from motionese.experiment.learner import BABBLING, Experience, Learner
from motionese.experiment.scene import Scene
from motionese.experiment.settings import Settings
from motionese.experiment.tables import write_table
from motionese.files import write_whole
from motionese.learning import Motions, train
from motionese.network import MTRNN

ENDED = "ended.json"


@dataclass(frozen=True)
class Run:
    """A condition with a seed, the folder it is kept in, and whose demonstrations it is shown.

    Attributes:
        condition: The condition.
        seed: The seed.
        folder: The folder.
        shown: A digest of recorded demonstrations; empty for the scripted caregiver.
    """

    condition: Condition
    seed: int
    folder: Path
    shown: str = ""

    @property
    def name(self) -> str:
        """How people are told of it, such as 'TD/MD seed 100'."""
        return f"{self.condition.name} seed {self.seed}"

    def origin(self, settings: Settings) -> str:
        """Return what its checkpoints are marked with: the run, and a digest of its settings."""
        text = json.dumps(settings.model_dump(mode="json"), sort_keys=True)
        shown = f", demonstrations {self.shown}" if self.shown else ""
        return f"{self.name}, settings {hashlib.sha256(text.encode()).hexdigest()[:12]}{shown}"

    def loops_done(self) -> int:
        """Return the number of its last whole loop, 0 before the first."""
        return len(list(self.folder.glob("loop-*.safetensors")))

    def ended(self) -> Row | None:
        """Return how the run ended (`status`, `reason`, `seconds`), or None while it has not.

        Raises:
            StorageError: The file that tells it cannot be read.
        """
        path = self.folder / ENDED
        try:
            ended = json.loads(path.read_text()) if path.is_file() else None
        except (OSError, ValueError):
            ended = {}
        if ended is not None and not (isinstance(ended, dict) and "status" in ended):
            raise StorageError(f"{path}: cannot be read; remove it, and the run is evaluated again")
        return ended


def go_through(
    run: Run,
    settings: Settings,
    told: Callable[[int], None],
    caregiver: Caregiver | None = None,
) -> Row:
    """Do what is left of a run, and return how it ended.

    Args:
        run: The run.
        settings: All settings.
        told: Called after every loop with its number.
        caregiver: Who shows the motions; the scripted caregiver if left out.

    Raises:
        StorageError: A checkpoint that is cut short, or of another run or other settings.
    """
    ended = run.ended()
    if ended:
        return ended
    run.folder.mkdir(parents=True, exist_ok=True)
    scene = Scene(settings, run.seed, caregiver)
    checkpoint = latest_checkpoint(run.folder, run.origin(settings))
    while checkpoint is None or (
        checkpoint.loop < settings.phases.loops and not checkpoint.failure
    ):
        checkpoint = _next_loop(run, scene, checkpoint)
        write_checkpoint(run.folder, checkpoint)
        told(checkpoint.loop)
    return _finish(run, scene, checkpoint)


def _next_loop(run: Run, scene: Scene, before: Checkpoint | None) -> Checkpoint:
    began = time.perf_counter()
    settings = scene.settings
    loop = before.loop + 1 if before else 1
    learner = before.learner if before else born(run.condition, scene)
    phase = 1 if loop <= settings.phases.change_after else 2
    if loop == settings.phases.change_after + 1:
        while len(learner.network.levels) < len(settings.network.levels):
            # The network's own key: a level that opens late gets the weights, times the influence,
            # that the same seed gives it in a network that has it from the start.
            learner = learner.grown(settings.network, key_for(run.seed, "network"))
    opened = {f"{k}_at_opening": v for k, v in development(learner).items() if k.startswith("rms")}
    known = {k: v for k, v in before.development.items() if k in opened} if before else {}
    lessons = settings.lessons(run.condition.teaching)
    capacity = settings.imitation.memory * max(len(lesson) for lesson in lessons)
    learner, rows, grown, status = imitation_loop(
        scene, learner, lessons[phase - 1], loop, capacity
    )
    return Checkpoint(
        origin=run.origin(settings),
        loop=loop,
        learner=learner,
        rows=[{"loop": loop, "phase": phase, **row} for row in rows],
        development={**grown, **opened, **known},
        failure=f"loop {loop}: {status}" if status.failed else "",
        seconds=(before.seconds if before else 0.0) + time.perf_counter() - began,
    )


def newborn(condition: Condition, scene: Scene) -> MTRNN:
    """Draw the network of a scene's seed, of all levels (MND) or of IO and Cf alone (MD)."""
    settings = scene.settings.network
    levels = settings.drawn_levels()
    return MTRNN(
        levels if condition.structuring == "MND" else levels[:2],
        key=key_for(scene.seed, "network"),
        gain=settings.gain,
        scale=settings.scale,
        learned_bias=settings.learned_bias,
        initial_io=settings.initial_io,
        channels=scene.body.channels,
    )


def born(condition: Condition, scene: Scene) -> Learner:
    """Draw the network, and let it learn from babbling."""
    settings = scene.settings
    network = newborn(condition, scene)
    learner = Learner(network)
    if not settings.babbling.movements:
        return learner
    copied = settings.imitation.efference_copy
    babbled = [
        scene.babble(index).experience(copied) for index in range(settings.babbling.movements)
    ]
    fit = train(
        network,
        Motions.from_arrays(babbled, scene.body.channels, scene.body.rate_hz),
        epochs=settings.babbling.epochs,
        settings=for_levels(settings.training, learner).model_copy(update={"noise": {}}),
    )
    states = zip(babbled, fit.initial_states, strict=True)
    return Learner(fit.network, tuple(Experience(0, BABBLING, v, s) for v, s in states))


def _finish(run: Run, scene: Scene, last: Checkpoint) -> Row:
    """Write the run's tables; evaluate it if it did not fail."""
    began = time.perf_counter()
    paths = [checkpoint_path(run.folder, loop) for loop in range(1, last.loop + 1)]
    loops = [read_checkpoint(path, last.origin) for path in paths]
    tables = {
        "loops.csv": [row for checkpoint in loops for row in checkpoint.rows],
        "development.csv": [checkpoint.development for checkpoint in loops],
    }
    if not last.failure:
        lessons = scene.settings.lessons(run.condition.teaching)
        tables["triples.csv"], imitated = imitate_new_motions(scene, last.learner, lessons)
        tables["slow_state_map.csv"] = map_slow_states(scene, last.learner)
        kept = io.BytesIO()
        np.savez_compressed(kept, allow_pickle=False, **inside(scene, last.learner, imitated))
        write_whole(run.folder / "inside.npz", kept.getvalue())
    who = {"condition": run.condition.name, "seed": run.seed}
    for name, rows in tables.items():
        write_table(run.folder / name, [{**who, **row} for row in rows])
    ended = {
        "status": "diverged" if last.failure else "finished",
        "reason": last.failure,
        "rows": {name: len(rows) for name, rows in tables.items()},
        "seconds": round(last.seconds + time.perf_counter() - began, 2),
    }
    write_whole(run.folder / ENDED, json.dumps(ended, indent=1))
    return ended
