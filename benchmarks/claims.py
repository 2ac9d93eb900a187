"""Whether a robot that says "I can do this" can do it.

A person's hand shows 20 motions to each robot: every sequence of up to three strokes and two of
four, on ways that stray by 0.3 to 1.5 cm. The robot says whether it can do what it saw, and then
tries: a claim is right if the imitation misses by no more than 2 cm and presses every button that
is due. Beside trained robots, each as its last loop left it, those of the same seeds are asked
before they have learned anything. The trained ones are those of run folders, or else go through
the experiment `order` first, which takes about half a minute each.

    python benchmarks/claims.py [RUN-FOLDER …]
"""

import os
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from motionese.one_core import one_core

os.environ.update(one_core())
sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))

import numpy as np
from hands import straying
from rich.console import Console
from rich.table import Table

from motionese.experiment import condition_named, go_through, read_settings
from motionese.experiment.learned_robot import robot_of
from motionese.experiment.run_folder import open_run_folder
from motionese.imitation import Learner, Scene, babbled, newborn
from motionese.task import PrimitiveSequence, Task
from motionese.teaching.session import Teaching

FOUR = ("UR ↓↑←↓", "LR ↑←↓↑")
STRAYS_CM = (0.3, 1.5)
PRESET, SEEDS, RIGHT = "order", range(15, 20), 0.9


def motions(task: Task) -> list[PrimitiveSequence]:
    """Return the 20 motions that are shown."""
    three = [s for length in (1, 2, 3) for s in task.sequences(length)]
    return three + [task.sequence(name) for name in FOUR]


def claims(scene: Scene, learner: Learner) -> Iterator[tuple[bool, bool]]:
    """Yield for every motion whether the robot claims to be able to do it, and whether it is."""
    rng, caregiver = np.random.default_rng(scene.seed), scene.caregiver()
    for sequence in motions(scene.task):
        way = caregiver.demonstrate(sequence, rng).path
        path = scene.body.reachable(straying(way, rng, rng.uniform(*STRAYS_CM)))
        teaching = Teaching(scene, learner)  # that has not tried anything
        claimed = teaching.show(path, "drawn").verdict.claim.made
        yield claimed, teaching.imitate().result.good


def measured(kind: str, asked: list[tuple[bool, bool]]) -> list[str]:
    """Return a row of the table."""
    claimed, can = np.array(asked).T
    right, able = int((claimed & can).sum()), int(can.sum())
    shares = [f"{right / n:.0%}" if n else "–" for n in (int(claimed.sum()), able)]
    return [kind, str(len(can)), str(able), str(int(claimed.sum())), str(right), *shares]


def train(path: Path) -> None:
    """Let robots go through the experiment in a run folder."""
    settings = read_settings(PRESET)
    with open_run_folder(path, settings, PRESET) as folder:
        for seed in SEEDS:
            run = folder.run(condition_named("TD/MD", settings.factors), seed)
            go_through(run, settings, lambda *told: None)


def main(folders: list[Path]) -> None:
    """Ask all robots of run folders, print."""
    console, table = Console(markup=False), Table(title="“I can do this”")
    for heading in ("robot", "motions", "it can do", "claims", "right", "of claims", "recall"):
        table.add_column(heading, justify="right" if table.columns else "left")
    pooled: dict[str, list[tuple[bool, bool]]] = {}
    for run in [run for folder in folders for run in sorted(folder.glob("*/seed-*"))]:
        robot = robot_of(run)
        scene = Scene(robot.settings, robot.seed)
        bare = newborn(scene, 2)
        kinds = {"newborn": bare, "babbled": babbled(scene, bare), "trained": robot.learner}
        for kind, learner in kinds.items():
            asked = list(claims(scene, learner))
            pooled.setdefault(kind, []).extend(asked)
            table.add_row(*measured(f"{kind}, seed {robot.seed}", asked))
    table.add_section()
    for kind, asked in pooled.items():
        table.add_row(*measured(f"{kind}, all", asked))
    console.print(table)
    console.print(f"targets: 0 claims of newborns, ≥ {RIGHT:.0%} right of those of trained robots")


if __name__ == "__main__":
    if len(sys.argv) > 1:
        main([Path(argument) for argument in sys.argv[1:]])
    else:
        with tempfile.TemporaryDirectory() as name:
            train(Path(name))
            main([Path(name)])
