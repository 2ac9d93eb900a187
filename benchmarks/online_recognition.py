"""Recognition while it happens: how long a reading takes, and whether a loop of 100 Hz follows.

A reading with two damped steps, the belief and five rows ahead (NumPy) stands beside what a user
would do else: recognise the window anew with the library, warm, by 15 updates of Adam or 2 damped
steps (JAX). Then a robot follows a motion for 60 s at 100 Hz on one core.

    python benchmarks/online_recognition.py
"""

import os
from collections.abc import Callable
from time import perf_counter

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["OMP_NUM_THREADS"] = os.environ["OPENBLAS_NUM_THREADS"] = "1"

import jax
import numpy as np
from numpy import ndarray
from rich.console import Console
from rich.table import Table

import motionese as mo
from motionese.learning import Motions, Recognition, recognise_all, runtime_model
from motionese.runtime import ControlLoop, OnlineRecognition

MODELS = {
    "6 channels, 40 + 2 context units, window 20": ((6, 40, 2), 20, 1.0),
    "8 channels, 64 + 12 context units, window 25": ((8, 64, 12), 25, 2.0),
}
RATE_HZ, SECONDS, MOTIONS, ROWS = 100.0, 60.0, 12, 60


def trained(sizes: tuple[int, ...]) -> tuple[mo.Fit, list[ndarray]]:
    """Train shortly on smooth random motions: what a reading costs does not depend on them."""
    rng, t = np.random.default_rng(0), np.linspace(0.0, 2 * np.pi, ROWS)[:, None]
    arrays = [
        np.sin(t * rng.uniform(0.5, 2, sizes[0]) + rng.uniform(0, 6, sizes[0]))
        for _ in range(MOTIONS)
    ]
    names = [f"joint {i}" for i in range(sizes[0])]
    motions = mo.Motions.from_arrays(arrays, names, RATE_HZ)
    levels = [mo.Level(s, tau) for s, tau in zip(sizes, (2.0, 5.0, 70.0), strict=True)]
    return mo.train(mo.MTRNN.draw(levels, key=jax.random.key(0)), motions, epochs=500), arrays


def milliseconds(step: Callable[[], object], count: int) -> tuple[float, float]:
    """Measure a step's median and 99th percentile [ms]."""
    took = np.empty(count)
    for i in range(count):
        began = perf_counter()
        step()
        took[i] = perf_counter() - began
    return 1e3 * float(np.median(took)), 1e3 * float(np.percentile(took, 99))


def online(fit: mo.Fit, path: ndarray, window: int) -> Callable[[], object]:
    """A reading of half of the channels, in a window that is full."""
    seen = list(fit.network.channels.names[::2])
    recognition = OnlineRecognition(runtime_model(fit), observed=seen, window=window)
    rows = iter(np.tile(path, (200, 1)))
    for _ in range(window):
        recognition.observe(next(rows))
    return lambda: recognition.observe(next(rows))


def anew(fit: mo.Fit, path: ndarray, window: int, how: Recognition) -> Callable[[], object]:
    """The window recognised by the library, from where it was."""
    mask = np.zeros((window, path.shape[1]), dtype=bool)
    mask[:, ::2] = True
    motions = Motions.from_arrays([path[:window]], fit.network.channels, RATE_HZ, observed=[mask])
    start = np.asarray(fit.initial_states[:1])[None]
    step = lambda: recognise_all(fit.network, motions, starts=start, settings=how)  # noqa: E731
    step()
    return step


def time_readings(console: Console) -> None:
    """Print a table of the ways."""
    adam = Recognition(optimiser="adam", iterations=15, starts=0, rate=0.1)
    damped = Recognition(iterations=2, starts=0)
    for name, (sizes, window, target) in MODELS.items():
        fit, arrays = trained(sizes)
        table = Table(title=f"One reading, {name}; target ≤ {target:g} ms in NumPy")
        for heading in ("", "median [ms]", "99 % [ms]", "× the first"):
            table.add_column(heading, justify="left" if not heading else "right")
        ways = {
            "online, NumPy, 2 damped steps": (online(fit, arrays[0], window), 5000),
            "library, JAX, 2 damped steps": (anew(fit, arrays[0], window, damped), 200),
            "library, JAX, 15 updates of Adam": (anew(fit, arrays[0], window, adam), 200),
        }
        first = 0.0
        for label, (step, count) in ways.items():
            median, slow = milliseconds(step, count)
            first = first or median
            table.add_row(label, f"{median:.2f}", f"{slow:.2f}", f"{median / first:.1f}")
        console.print(table)


def follow(console: Console) -> None:
    """Let a robot follow what is shown at 100 Hz, and print what it missed."""
    sizes, window, _ = next(iter(MODELS.values()))
    fit, arrays = trained(sizes)
    model, names = runtime_model(fit), fit.network.channels.names
    steps = int(SECONDS * RATE_HZ)
    rows = iter(np.tile(np.concatenate(arrays), (1 + steps // (MOTIONS * ROWS), 1)))
    loop = ControlLoop(
        model, lambda: dict(zip(names, next(rows), strict=True)), lambda command: None
    )
    recognition = OnlineRecognition(model, observed=list(names[::2]), window=window, budget_ms=8)
    ran = loop.follow(recognition, steps)
    console.print(
        f"{RATE_HZ:g} Hz for {SECONDS:g} s: {ran.steps} commands, {ran.missed} deadlines missed, "
        f"{recognition.postponed} damped steps postponed, worst lateness "
        f"{1e3 * ran.worst_lateness_s:.2f} ms of {1e3 / RATE_HZ:g} ms, "
        f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores"
    )


def main() -> None:
    """Measure and print."""
    console = Console()
    time_readings(console)
    follow(console)


if __name__ == "__main__":
    main()
