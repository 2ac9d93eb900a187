"""How long `motionese inspect` takes for a large table, beside pandas reading the same file.

A table of 100,000 rows and 60 channels [rad] beside its time, once with six decimals as a
controller logs them and once with all digits. For each:

1. `pandas.read_csv`; reading alone; and what `motionese inspect` does from the file to the figure,
   less what it takes for the first rows of the same table, as many as are drawn as they are, which
   is what drawing takes whatever the size. In turns, in time of the processor: the medians.
2. The most memory that reading and all of it hold beyond what the process held before, as a
   multiple of the numbers themselves (48 MB), each in a process of its own.

    python benchmarks/reading_tables.py
"""

import io
import resource
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import process_time

import numpy as np
import pandas as pd
from rich.console import Console
from rich.table import Table

ROWS, CHANNELS, FEW, TURNS = 100_000, 60, 480, 7
BYTES = ROWS * CHANNELS * 8
TIMES, MEMORY = 2.0, 4.0
"""The targets: as many times as long as pandas, and as much memory as the numbers."""
KINDS = {"six decimals": "%.6f", "all digits": None}


def write_table(path: Path, rows: int, decimals: str | None) -> None:
    """Write a table of joints that wander."""
    steps = np.random.default_rng(0).normal(scale=0.01, size=(ROWS, CHANNELS))
    names = ["time [s]", *(f"joint {i} [rad]" for i in range(CHANNELS))]
    values = np.column_stack([np.arange(ROWS) / 100, steps.cumsum(axis=0)])[:rows]
    pd.DataFrame(values, columns=names).to_csv(path, index=False, float_format=decimals)


def seconds(call: Callable[[], object]) -> float:
    """Return the time of the processor of a call [s]."""
    start = process_time()
    call()
    return process_time() - start


def most_memory() -> int:
    """Return the most memory that this process has held [bytes]."""
    unit = 1 if sys.platform == "darwin" else 1024
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * unit


def measure(what: str, path: Path, few: Path) -> None:
    """Print seconds, or bytes, of one thing, or write a kind of table; in a process of its own."""
    if what in KINDS:
        write_table(path, ROWS, KINDS[what])
        write_table(few, FEW, KINDS[what])
        return
    from motionese.interfaces.commands.inspect import inspect_recordings
    from motionese.interfaces.commands.recording_options import as_read
    from motionese.recordings import read

    def inspect(source: Path) -> None:
        plot = path.with_suffix(".svg")
        inspect_recordings(Console(file=io.StringIO()), source, plot, as_read(rate=None))

    inspect(few)
    if what == "times":
        calls = (
            lambda: pd.read_csv(path),
            lambda: read(path),
            lambda: inspect(path),
            lambda: inspect(few),
        )
        turns = zip(*([seconds(call) for call in calls] for _ in range(TURNS)), strict=True)
        pandas, reading, whole, drawing = map(median, turns)
        print(pandas, reading / pandas, (whole - drawing) / pandas)
    else:
        before = most_memory()
        read(path) if what == "memory read" else inspect(path)
        print(most_memory() - before)


def main() -> None:
    """Measure and print a table; exit status 1 where a target is missed."""
    table, missed = (
        Table("table", "pandas [s]", "read", "inspect", "memory: read", "inspect"),
        False,
    )
    with tempfile.TemporaryDirectory() as folder:
        for kind in KINDS:
            path, few = Path(folder) / "large.csv", Path(folder) / "few.csv"

            def of(what: str, path: Path = path, few: Path = few) -> list[float]:
                command = [sys.executable, __file__, what, str(path), str(few)]
                ran = subprocess.run(command, check=True, capture_output=True)
                return list(map(float, ran.stdout.split()))

            # A process is said to hold what the one that starts it held: that must be little.
            of(kind)
            pandas, *times = of("times")
            memory = [of(what)[0] / BYTES for what in ("memory read", "memory inspect")]
            missed |= times[-1] > TIMES or memory[-1] > MEMORY
            ratios = (f"{ratio:.2f} ×" for ratio in (*times, *memory))
            table.add_row(kind, f"{pandas:.3f}", *ratios)
    Console().print(table)
    sys.exit(missed)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        measure(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
    else:
        main()
