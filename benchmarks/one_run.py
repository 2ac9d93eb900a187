"""One run of the default experiment, against the time a robot would need to make the same motions.

Thirty loops of TD/MD on the MuJoCo body with all that belongs to them: babbling, demonstrations,
recognition, performance, training, checkpoints, evaluation. The first run compiles (unless JAX
finds its compilations kept); the second shows what a run costs in a process that goes on. A robot
at 10 Hz needs the time of its motions and of those it is shown, and none to think.

    python benchmarks/one_run.py
"""

import os
import tempfile
from pathlib import Path
from time import perf_counter

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"

from rich.console import Console
from rich.table import Table

from motionese.experiment import Run, condition_named, go_through, read_settings

SETTINGS = read_settings()
TD_MD = condition_named("TD/MD", SETTINGS.factors)


def seconds(seed: int) -> float:
    """Do a whole run in a folder that is thrown away."""
    with tempfile.TemporaryDirectory() as folder:
        began = perf_counter()
        go_through(Run(TD_MD, seed, Path(folder)), SETTINGS, lambda loop: None)
        return perf_counter() - began


def on_a_robot() -> float:
    """Return how long [s] the shown and the performed motions of a run last."""
    rows = sum(
        stage.until.loops * stage.manner.rows(sequence)
        for stage in SETTINGS.development(TD_MD)
        for sequence in stage.lesson
    )
    return 2 * rows / SETTINGS.body.rate_hz


def main() -> None:
    """Measure and print."""
    robot = on_a_robot()
    table = Table(title="A run of TD/MD: 30 loops and the evaluation")
    for column in ("", "seconds", "times faster than a robot moves"):
        table.add_column(column, justify="right")
    for name, seed in (("first run of a process", 1000), ("second run", 1001)):
        took = seconds(seed)
        table.add_row(name, f"{took:.1f}", f"{robot / took:.0f}")
    Console().print(table)


if __name__ == "__main__":
    main()
