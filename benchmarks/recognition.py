"""Recognition of learned pairs: damped steps of least squares against 800 updates of Adam.

A robot goes through the 30 loops of TD/MD for every seed; then it recognises and performs fresh
demonstrations of the four pairs it was taught, from the same starts by either way. Times are of one
process on one core, after compilation; errors are of the same networks and demonstrations, paired.

    python benchmarks/recognition.py [SEEDS]
"""

import os
import sys
import tempfile
from pathlib import Path
from time import perf_counter

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["OMP_NUM_THREADS"] = "1"

import numpy as np
from rich.console import Console
from rich.table import Table

from motionese.analysis.statistics import contrast, estimate
from motionese.experiment import Run, condition_named, go_through, read_settings
from motionese.imitation import Learner, Scene, imitate, read_learner
from motionese.learning import Recognition, recognise_all

SETTINGS = read_settings()
TD_MD = condition_named("TD/MD", SETTINGS.factors)
PAIRS = SETTINGS.task.task().lesson("taught pairs")
WAYS = {
    "Adam, 800": {"optimiser": "adam", "iterations": 800},
    "least squares, 5": {"iterations": 5},
    "least squares, 8": {"iterations": 8},
    "least squares, 30 (default)": {},
}
REPEATS = 15


def learned(seed: int) -> Learner:
    """Return what a robot becomes in 30 loops."""
    with tempfile.TemporaryDirectory() as folder:
        run = Run(TD_MD, seed, Path(folder))
        go_through(run, SETTINGS, lambda loop: None)
        return read_learner(Path(folder) / "loop-30.safetensors")[0]


def error_cm(scene: Scene, learner: Learner, way: Recognition) -> float:
    """Return the mean imitation error of fresh demonstrations."""
    rows = [each.measures(scene) for each in imitate(scene, learner, PAIRS, way, "benchmark")]
    return float(np.mean([row["imitation_error_cm"] for row in rows]))


def seconds(scene: Scene, learner: Learner, way: Recognition) -> float:
    """Return the median time [s] to recognise the four pairs."""
    shown = [scene.as_own(pair.start, scene.show(pair, "benchmark")) for pair in PAIRS]
    starts = np.array([learner.start_for(pair) for pair in PAIRS])[:, None]
    took = []
    for _ in range(REPEATS + 1):
        began = perf_counter()
        recognise_all(learner.network, scene.to_recognise(shown), starts=starts, settings=way)
        took.append(perf_counter() - began)
    return float(np.median(took[1:]))


def main(seeds: int) -> None:
    """Measure and print."""
    ways = {name: SETTINGS.recognition.model_copy(update=how) for name, how in WAYS.items()}
    errors, took = np.zeros((len(ways), seeds)), np.zeros((len(ways), seeds))
    for seed in range(seeds):
        scene, learner = Scene(SETTINGS, 1100 + seed), learned(1100 + seed)
        for place, way in enumerate(ways.values()):
            errors[place, seed] = error_cm(scene, learner, learner.for_levels(way))
            took[place, seed] = seconds(scene, learner, learner.for_levels(way))
    table = Table(title=f"Four learned pairs, {seeds} seeds of TD/MD")
    for column in ("", "ms", "× faster", "error [cm]", "difference to Adam, mean [95 %]"):
        table.add_column(column, justify="right")
    for place, name in enumerate(ways):
        apart = contrast(errors[place] - errors[0], "difference")
        table.add_row(
            name,
            f"{1000 * np.median(took[place]):.0f}",
            f"{np.median(took[0] / took[place]):.1f}",
            f"{estimate(errors[place]).value:.2f}",
            f"{apart.value:+.2f} [{apart.low:+.2f}, {apart.high:+.2f}]" if place else "",
        )
    Console().print(table)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
