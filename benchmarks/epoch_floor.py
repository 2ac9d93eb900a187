"""How near an epoch of training comes to its arithmetic, on one core.

Small networks against the same epoch in plain C (`plain_c/epoch.c`: equation (3) over all motions,
its gradient, one update with momentum), a larger one against the matrix products alone, as BLAS
does them. All in one process, in turns; times are of the processor. Both must come to the same
losses. Without a C compiler this says so and ends.

    python benchmarks/epoch_floor.py
"""

import ctypes
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from time import process_time

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import jax
import numpy as np
from rich.console import Console
from rich.table import Table

from motionese import MTRNN, Level, Motions, Training, train
from motionese.network import wiring

SOURCE = Path(__file__).parent / "plain_c" / "epoch.c"
FLAGS = ("-O3", "-march=native", "-ffast-math", "-shared", "-fPIC")
VECTOR = 16
"""Units are padded in C to whole vectors of so many float32."""
SETTINGS = Training(
    optimiser="momentum",
    weight_rate=1e-3,
    initial_rate=1e-2,
    schedule="constant",
    clip=0.0,
    bound={},
    teacher_forcing=0.3,
)
SMALL = (((2, 10, 3), 2, 100), ((6, 40, 2), 9, 80))
LARGE = ((8, 200, 48), 32, 200)
"""Units of each level, motions, steps."""
TAUS, EPOCHS, ROUNDS = (2.0, 5.0, 70.0), {15: 3000, 48: 1000, 256: 10}, 7
BARS = {15: 2.5, 48: 1.7, 256: 1.8}
FLOATS = ctypes.POINTER(ctypes.c_float)


def curves(channels: int, motions: int, steps: int) -> Motions:
    """Smooth random motions."""
    rng = np.random.default_rng(0)
    t = np.linspace(0.0, 2 * np.pi, steps)[:, None, None]
    phases = rng.uniform(0, 6, (motions, 1, 3, channels))
    waves = np.sin(t * rng.uniform(0.5, 2.0, (3, channels)) + phases).mean(2)
    return Motions.from_arrays(list(waves), [f"channel {i}" for i in range(channels)], 10.0)


class InC:
    """A training in plain C, that goes on from call to call."""

    def __init__(self, compiler: str, folder: Path, network: MTRNN, motions: Motions) -> None:
        batch = motions.batch()
        count, steps, io = batch.sensed.shape
        self.units = -(-network.size // VECTOR) * VECTOR
        shape = {"UNITS": self.units, "IO": io, "MOTIONS": count, "STEPS": steps}
        path = folder / f"epoch-{network.size}.so"
        options = (f"-D{name}={value}" for name, value in shape.items())
        subprocess.run([compiler, *FLAGS, *options, SOURCE, "-o", path, "-lm"], check=True)
        self.run = ctypes.CDLL(str(path)).epochs
        idle = self.units - network.size
        first = np.array(batch.sensed[:, 0])
        states = np.zeros((count, self.units))
        states[:, :io] = np.log(first) - np.log1p(-first)
        share = SETTINGS.teacher_forcing * np.array(batch.observed)
        share[:, 0] = batch.observed[:, 0]
        learned = (np.pad(network.weights, (0, idle)), np.zeros(self.units), states)
        fixed = (
            np.pad(wiring(network.sizes), (0, idle)),
            np.pad(1 / np.array(network.tau), (0, idle), constant_values=1.0),
            *(np.swapaxes(rows, 0, 1) for rows in (batch.sensed, share, batch.weight)),
        )
        arrays = (*learned, *map(np.zeros_like, learned), *fixed)
        self.arrays = [np.array(array, np.float32, order="C") for array in arrays]

    def epochs(self, count: int) -> np.ndarray:
        """Go on for so many epochs; return the loss before each one's update."""
        losses = np.zeros(count, np.float32)
        rates = (SETTINGS.weight_rate, SETTINGS.initial_rate, SETTINGS.momentum)
        self.run(
            ctypes.c_int(count),
            *(array.ctypes.data_as(FLOATS) for array in self.arrays),
            *map(ctypes.c_float, rates),
            losses.ctypes.data_as(FLOATS),
        )
        return losses


class Products:
    """The matrix products of an epoch alone: one a step forward, one a step back, the weights'."""

    def __init__(self, units: int, motions: int, steps: int) -> None:
        rng = np.random.default_rng(0)
        self.weights = rng.random((units, units), np.float32)
        self.rows = rng.random((steps, motions, units), np.float32)

    def epochs(self, count: int) -> None:
        """Compute the products of so many epochs."""
        flat = self.rows.reshape(-1, len(self.weights))
        for _ in range(count):
            for row in self.rows:
                row @ self.weights
                row @ self.weights
            flat.T @ flat


def milliseconds(function, epochs: int) -> float:
    """Measure the processor's time an epoch takes."""
    began = process_time()
    function(epochs)
    return (process_time() - began) / epochs * 1e3


def measured(sizes: tuple[int, ...], count: int, steps: int, compiler: str) -> tuple[str, ...]:
    """Time epochs here and there in turns; return a row of the table."""
    units, motions = sum(sizes), curves(sizes[0], count, steps)
    levels = [Level(size, tau) for size, tau in zip(sizes, TAUS, strict=True)]
    network = MTRNN.draw(levels, key=jax.random.key(0))

    def here(epochs: int) -> np.ndarray:
        return train(network, motions, settings=SETTINGS, epochs=epochs).losses

    with tempfile.TemporaryDirectory() as folder:
        in_c = InC(compiler, Path(folder), network, motions)
    epochs, bar = EPOCHS[units], BARS[units]
    worst = float(np.max(np.abs(here(epochs)[:10] / in_c.epochs(10) - 1)))
    if worst > 1e-4:
        sys.exit(f"{units} units: the losses of the first epochs differ by a share of {worst:.1e}")
    product = Products(units, count, steps)
    turns = [
        [milliseconds(function, epochs) for function in (here, in_c.epochs, product.epochs)]
        for _ in range(ROUNDS)
    ]
    mine, plain, products = np.median(turns, axis=0)
    of_c, of_products = np.median([(a / b, a / c) for a, b, c in turns], axis=0)
    ratio, floor = (of_products, "products") if (sizes, count, steps) == LARGE else (of_c, "C")
    told = f"{'met' if ratio <= bar else 'missed'}: {bar:g} × {floor}"
    size = f"{'/'.join(map(str, sizes))}, {count} × {steps}"
    times = (f"{time:.3f}" for time in (mine, plain, products))
    return size, *times, f"{of_c:.2f}", f"{of_products:.2f}", told


def main() -> None:
    """Build, check that the losses agree, measure, print."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None:
        print("No C compiler (cc, gcc) is here, so there is nothing to compare with.")
        return
    table = Table(title="One epoch in ms, medians")
    columns = ("units, motions × steps", "motionese", "plain C", "products", "× C", "× products")
    for column in (*columns, "bar"):
        table.add_column(column, justify="right")
    for problem in (*SMALL, LARGE):
        table.add_row(*measured(*problem, compiler))
    Console().print(table)


if __name__ == "__main__":
    main()
