"""Many motions learned in batches and all at once; and motions that stay on the disk.

1,000 episodes of 200 rows of 8 channels, each one of 300 motifs in a size, a phase and a scatter of
its own, are learned by 60 fast and 12 slow units on one core until the error in closed loop is 5 %
of range: first in batches of 50, then all at once, for at most as many seconds as make the ratio
that is aimed at, with a schedule that ends there. Times are of the processor, of training alone;
each training has a process of its own, whose largest memory is told.

Then a file of three times the memory that is allowed is learned from where it is.

    python benchmarks/large_recordings.py [--small] [batches] [stored] [threads]
"""

import json
import os
import resource
import subprocess
import sys
import tempfile
from contextlib import suppress
from dataclasses import asdict, dataclass
from pathlib import Path
from time import monotonic, process_time

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["OMP_NUM_THREADS"] = "1"

import h5py
import jax
import numpy as np
from rich.console import Console
from rich.table import Table

from motionese import MTRNN, Level, Motions, Training, train
from motionese.learning import Progress

RATIO, MEMORY_GB, ALLOWED_GB = 4.0, 1.5, 0.64
console = Console()


@dataclass(frozen=True)
class Size:
    """How much is learned, and for how long."""

    episodes: int = 1000
    rows: int = 200
    channels: int = 8
    motifs: int = 300
    batch: int = 50
    epochs: int = 200
    error: float = 0.05
    stored_episodes: int = 10_000
    stored_rows: int = 1000
    stored_channels: int = 24


FULL = Size()
SMALL = Size(120, 80, 4, 40, 20, 300, 0.06, 1000, 500, 24)


class ReachedError(Exception):
    """The error is reached, or the time is up."""


def episodes(size: Size) -> Motions:
    """Return the episodes: a wave a channel, as the motif has them, a little changed."""
    rng, d = np.random.default_rng(0), size.channels
    motifs = [(rng.uniform(0.3, 1.0, d), rng.uniform(0, 1, d)) for _ in range(size.motifs)]
    t = np.linspace(0.0, 1.0, size.rows)[:, None]
    shown = []
    for _ in range(size.episodes):
        pace, phase = motifs[rng.integers(size.motifs)]
        own = rng.normal(1.0, 0.05, d), phase + rng.normal(0.0, 0.01, d)
        shown.append(own[0] * np.sin(2 * np.pi * (t * pace + own[1])))
    noisy = [values + rng.normal(0.0, 0.005, values.shape) for values in shown]
    return Motions.from_arrays(noisy, [f"channel {i}" for i in range(d)], 20.0)


def network(channels: int) -> MTRNN:
    return MTRNN.draw(
        [Level(channels, 2.0), Level(60, 5.0), Level(12, 70.0)], key=jax.random.key(1)
    )


def trained(size: Size, batch: int, epochs: int, cap_s: float) -> dict[str, float]:
    """Train until the error is reached, or for so many seconds; return what it took."""
    motions = episodes(size)
    told: dict[str, float] = {}
    train(
        network(size.channels),
        motions,
        epochs=1,
        settings=Training(batch=batch),
        key=jax.random.key(2),
    )
    began = process_time()

    def progress(now: Progress) -> None:
        told.update(seconds=process_time() - began, epochs=now.epoch, error=now.closed_loop_error)
        console.print(f"  {now.epoch} epochs, {told['seconds']:.0f} s, {now.closed_loop_error:.1%}")
        if now.closed_loop_error <= size.error or told["seconds"] > cap_s:
            raise ReachedError

    settings = Training(epochs=epochs, batch=batch)
    with suppress(ReachedError):
        train(
            network(size.channels),
            motions,
            settings=settings,
            key=jax.random.key(2),
            progress=progress,
        )
    return told | {"gigabytes": peak_gb()}


def peak_gb() -> float:
    """Return the largest memory that this process has held."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024**2


def in_a_process(what: str, size: Size, *arguments: float) -> dict[str, float]:
    """Run one training in a process of its own."""
    told = json.dumps([what, asdict(size), *arguments])
    command = [sys.executable, __file__, "--one", told]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if line.startswith("{"):
                return json.loads(line)
            console.print(line.rstrip())
    sys.exit(f"{what}: the training failed")


def batches(size: Size) -> None:
    """Time training in batches against training on all motions at once."""
    console.print(f"In batches of {size.batch}, {size.epochs} epochs:")
    some = in_a_process("train", size, size.batch, size.epochs, 1e9)
    if some["error"] > size.error:
        sys.exit(f"in batches the error stays above {size.error:.0%}")
    cap = RATIO * some["seconds"]
    probe = in_a_process("train", size, 0, 10, 0.0)
    epochs = max(int(1.1 * cap / (probe["seconds"] / probe["epochs"])), 100)
    console.print(f"All at once, {epochs} epochs, {cap:.0f} s at most:")
    every = in_a_process("train", size, 0, epochs, cap)
    table = Table(title=f"{size.episodes} × {size.rows} rows × {size.channels} channels, one core")
    for heading in ("", "seconds", "epochs", "closed loop", "memory [GB]"):
        table.add_column(heading, justify="right")
    for name, told in ((f"batches of {size.batch}", some), ("all at once", every)):
        numbers = f"{told['seconds']:.0f}", f"{told['epochs']}", f"{told['error']:.1%}"
        table.add_row(name, *numbers, f"{told['gigabytes']:.2f}")
    console.print(table)
    reached = every["error"] <= size.error
    ratio = every["seconds"] / some["seconds"]
    met = ratio >= RATIO
    console.print(
        f"All at once {'reaches' if reached else 'has not reached'} {size.error:.0%} after "
        f"{ratio:.1f} times as long: the target of {RATIO:g} is {'met' if met else 'missed'}. "
        f"That of {MEMORY_GB} GB is {'met' if some['gigabytes'] <= MEMORY_GB else 'missed'}."
    )


def write_stored(path: Path, size: Size) -> None:
    """Write many episodes of noisy waves, one at a time, as robomimic does."""
    rng, t = np.random.default_rng(0), np.arange(size.stored_rows)[:, None] / 50
    with h5py.File(path, "w") as file:
        data = file.create_group("data")
        data.attrs["env_args"] = json.dumps({"env_kwargs": {"control_freq": 50.0}})
        for i in range(size.stored_episodes):
            pace, phase = rng.uniform(0.05, 0.2, (2, size.stored_channels))
            data[f"demo_{i}/obs/state"] = np.sin(2 * np.pi * (t * pace + phase))


def learned_from_disk(size: Size, path: str) -> dict[str, float]:
    """Learn a file for two epochs from where it is."""
    began = monotonic()
    motions = Motions.read(path, stored=True)
    looked_through = monotonic() - began
    settings = Training(epochs=2, batch=64)
    fit = train(network(size.stored_channels), motions, settings=settings, key=jax.random.key(2))
    assert fit.losses[1] < fit.losses[0]
    seconds = {"looking through": looked_through, "training": monotonic() - began - looked_through}
    return seconds | {"gigabytes": peak_gb()}


def stored(size: Size) -> None:
    """Compare the memory of learning from a file with its size."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "large.hdf5"
        write_stored(path, size)
        gigabytes = path.stat().st_size / 1024**3
        told = in_a_process("stored", size, str(path))
    console.print(
        f"A file of {gigabytes:.2f} GB: looked through in {told['looking through']:.0f} s, "
        f"two epochs in {told['training']:.0f} s, with {told['gigabytes']:.2f} GB of memory; "
        f"the target of {ALLOWED_GB} GB is {'met' if told['gigabytes'] <= ALLOWED_GB else 'missed'}"
    )


def threads(size: Size) -> None:
    """Time updates of several sizes on one and on two cores, in turns; the fastest of each."""
    table = Table(title="Milliseconds of an update (wall clock)")
    for heading in ("motions × rows", "one core", "two cores", "times faster"):
        table.add_column(heading, justify="right")
    for count in (2, 4, 8, 16, 64, 256):
        motions = episodes(size).chosen(range(min(count, size.episodes)))
        best = [np.inf, np.inf]
        for turn in range(10):
            devices = jax.devices()[: 1 + turn % 2]
            epochs = max(2048 // count, 2)
            for _ in range(2):  # the first time to compile
                began = monotonic()
                train(network(size.channels), motions, epochs=epochs, devices=devices)
            best[turn % 2] = min(best[turn % 2], (monotonic() - began) / epochs * 1e3)
        one, two = best
        shape = f"{len(motions)} × {size.rows}"
        table.add_row(shape, f"{one:.1f}", f"{two:.1f}", f"{one / two:.2f}")
    console.print(table)


def main() -> None:
    """Run what is asked for, or all of it."""
    if "--one" in sys.argv:
        what, size, *arguments = json.loads(sys.argv[-1])
        called = {"train": trained, "stored": learned_from_disk}[what]
        print(json.dumps(called(Size(**size), *arguments)))
        return
    size = SMALL if "--small" in sys.argv else FULL
    jax.config.update("jax_num_cpu_devices", 2 if "threads" in sys.argv else 1)
    parts = {"batches": batches, "stored": stored, "threads": threads}
    asked = [name for name in parts if name in sys.argv] or ["batches", "stored"]
    for name in asked:
        parts[name](size)


if __name__ == "__main__":
    main()
