"""From a CSV of recordings to a trained model, and the same training in plain PyTorch beside it.

The recordings: 30 episodes of 150 rows at 10 Hz, 8 joints [deg]. Every episode leaves a common rest
posture (off by 5 degrees or so) and reaches for 3 to 5 postures drawn from ±90 degrees, each in
a minimum-jerk movement of its own length, 2 s at least. No two episodes share a posture, so that
nothing learned from 27 of them foretells the other three: their error says how far the network can
be made to follow an unknown motion, not how well it generalises.

1. The command `motionese train`, as a user calls it, in a process of its own that finds nothing
   compiled: seconds from CSV to model, and the model's error in closed loop.
2. The same training in PyTorch, eager, with its own autograd and Adam, from the same weights and to
   the same losses, written in three ways: with a Linear for every link between levels, as cells
   are often written; as equations (1)–(3) read, with one weight matrix, as in `training_epoch.py`;
   and the same with all that can be computed before the loop taken out of it. Some epochs are timed
   in turns with ours, and scaled to all. On one thread times are compared by what they take of
   the processor, so that what else runs on the machine counts as little as possible; the processor
   times of several threads add up, so there the wall clock counts.
3. Recognition of the learned motions from a third of the channels.

    python benchmarks/from_csv_to_model.py
"""

import csv
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import perf_counter, process_time
from typing import NamedTuple

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"

import jax
import numpy as np
from rich.console import Console
from rich.table import Table

import motionese as mo
from motionese.learning import recognise_all

try:
    import torch
    from plain_torch.training import SETTINGS, SIZES, TAUS, epochs_in_torch
except ImportError:
    sys.exit("this benchmark compares with PyTorch: pip install torch")

EPISODES, ROWS, RATE_HZ, JOINTS, SEED = 30, 150, 10.0, SIZES[0], 0
EPOCHS_HERE, TURNS = 600, 3
EPOCHS_IN_TORCH = {torch.get_num_threads(): 3} | {1: 30}
"""How many epochs are timed in a turn, by number of threads: PyTorch's default, and one."""
SECONDS, CLOSED_LOOP, TIMES, HIDDEN = 30.0, 0.03, 15.0, 0.05
"""The targets."""
AGREE = 1e-4
"""So far may the losses of the first ten epochs differ."""


class Time(NamedTuple):
    """Time of the processor, all threads together, and of the wall clock."""

    processor: float
    wall: float


def write_recordings(path: Path) -> None:
    """Write the episodes, rounded as a controller would log them."""
    rng = np.random.default_rng(SEED)
    rest, shortest = rng.uniform(-90, 90, JOINTS), 20
    with path.open("w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["episode", "time", *(f"joint {i}" for i in range(1, JOINTS + 1))])
        for episode in range(EPISODES):
            count = int(rng.integers(3, 6))
            spare = (ROWS - 1 - shortest * count) * rng.dirichlet(np.full(count, 3.0))
            ends = np.round(np.cumsum([0, *(shortest + spare)])).astype(int)
            stops = rng.uniform(-90, 90, (count + 1, JOINTS))
            stops[0] = rest + rng.normal(0, 5, JOINTS)
            values = np.empty((ROWS, JOINTS))
            for begin, end, here, there in zip(ends, ends[1:], stops, stops[1:], strict=False):
                s = np.linspace(0, 1, end - begin + 1)[:, None]
                values[begin : end + 1] = here + (there - here) * (10 * s**3 - 15 * s**4 + 6 * s**5)
            for row, value in enumerate(values):
                table.writerow([episode, f"{row / RATE_HZ:.1f}", *(f"{v:.3f}" for v in value)])


def train_by_command(source: Path, out: Path) -> Time:
    """Run `motionese train` with nothing compiled; return how long it took [s]."""
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("XLA_", "JAX_"))}
    environment["XDG_CACHE_HOME"] = str(out.parent / "cache")
    code = "from motionese.interfaces.commands.command_line import main; main()"
    levels = ",".join(f"{s}:{t:g}" for s, t in zip(SIZES[1:], TAUS[1:], strict=True))
    options = ["--out", str(out), "--levels", levels, "--seed", str(SEED)]
    command = [sys.executable, "-c", code, "train", str(source), *options]
    began, before = perf_counter(), os.times()
    ran = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    wall, after = perf_counter() - began, os.times()
    if ran.returncode:
        sys.exit(f"motionese train failed: {ran.stderr or ran.stdout}")
    user = after.children_user - before.children_user
    return Time(user + after.children_system - before.children_system, wall)


def drawn_network() -> mo.MTRNN:
    """Return the network as the command draws it."""
    drawn, _ = jax.random.split(jax.random.key(SEED))
    return mo.MTRNN.draw([mo.Level(s, t) for s, t in zip(SIZES, TAUS, strict=True)], key=drawn)


def disagreement(ways: dict[str, Callable[[], float]], losses: np.ndarray) -> float:
    """Return by how much PyTorch's first losses differ from the command's, as a share of them."""
    torch.set_num_threads(1)
    off = {n: np.abs([epoch() for _ in range(10)] / losses[:10] - 1) for n, epoch in ways.items()}
    for name, shares in off.items():
        if shares.max() > AGREE:
            sys.exit(f"PyTorch, {name}: the losses differ by a share of {shares.max():.1e}")
    return float(max(shares.max() for shares in off.values()))


def per_epoch(work: Callable[[], object], epochs: int) -> Time:
    """Return how long an epoch takes [ms]."""
    wall, processor = perf_counter(), process_time()
    work()
    took = process_time() - processor, perf_counter() - wall
    return Time(*(t / epochs * 1e3 for t in took))


def in_turns(
    motions: mo.Motions, ways: dict[str, Callable[[], float]]
) -> tuple[list[Time], dict[tuple[str, int], list[Time]]]:
    """Time epochs of ours and of PyTorch's in turns [ms]."""
    network = drawn_network()

    def here() -> mo.Fit:
        return mo.train(network, motions, epochs=EPOCHS_HERE)

    here()
    ours: list[Time] = []
    theirs: dict[tuple[str, int], list[Time]] = {(w, n): [] for w in ways for n in EPOCHS_IN_TORCH}
    for _ in range(TURNS):
        ours.append(per_epoch(here, EPOCHS_HERE))
        for (way, threads), took in theirs.items():
            torch.set_num_threads(threads)
            count, epoch = EPOCHS_IN_TORCH[threads], ways[way]
            took.append(per_epoch(lambda f=epoch, n=count: [f() for _ in range(n)], count))
    return ours, theirs


def compare(console: Console, motions: mo.Motions, fit: mo.Fit, command: Time) -> None:
    """Check that PyTorch trains the same, and print how long both take."""
    ways = epochs_in_torch(drawn_network(), motions)
    differ = disagreement(ways, fit.losses)
    ours, theirs = in_turns(motions, ways)
    console.print(speed_table(len(motions), command, ours, theirs))
    console.print(
        f"PyTorch {torch.__version__}, {TURNS} turns of {EPOCHS_IN_TORCH[1]} epochs on one thread, "
        f"fewer on its default. The losses of its first 10 epochs agree with the command's to "
        f"{differ:.0e}. {load()}"
    )


def speed_table(
    motions: int, command: Time, ours: list[Time], theirs: dict[tuple[str, int], list[Time]]
) -> Table:
    """Return the medians; PyTorch is judged on as many threads as are better for it."""
    many = max(EPOCHS_IN_TORCH)
    title = f"{SETTINGS.epochs} epochs of {motions} motions: ms per epoch; × how many times slower"
    table = Table("", title=title)
    for heading in ("CPU", "wall", f"wall, {many} threads", "× training", "× command"):
        table.add_column(heading, justify="right")
    table.add_column(f"≥ {TIMES:g}", justify="right")
    thousands = SETTINGS.epochs / 1e3
    whole = Time(*(t / thousands for t in command))
    for name, cost in (("motionese", Time(*np.median(ours, axis=0))), ("  whole command", whole)):
        table.add_row(name, f"{cost.processor:.2f}", f"{cost.wall:.2f}")
    for way in dict.fromkeys(way for way, _ in theirs):
        costs = {n: Time(*np.median(theirs[way, n], axis=0)) for n in EPOCHS_IN_TORCH}
        slower = {}
        for n in EPOCHS_IN_TORCH:
            clock = 0 if n == 1 else 1
            pairs = zip(ours, theirs[way, n], strict=True)
            training = float(np.median([there[clock] / here[clock] for here, there in pairs]))
            slower[n] = training, costs[n][clock] / whole[clock]
        best = min(slower.values())
        table.add_row(
            f"PyTorch, {way}",
            *(f"{c:.2f}" for c in (*costs[1], costs[many].wall)),
            *(f"{b:.1f}" for b in best),
            "met" if best[0] >= TIMES else "missed",
        )
    return table


def recognise(console: Console, motions: mo.Motions, fit: mo.Fit) -> None:
    """Recognise the learned motions from every third channel: from the first on, from the third."""
    table = Table(title=f"{len(motions)} learned motions recognised: errors of hidden joints")
    for heading in ("observed", "median", "worst motion", "worst joint", "≤ 5 %"):
        table.add_column(heading, justify="right" if table.columns else "left")
    for first in (0, 2):
        seen = motions.channels.names[first::3]
        found = recognise_all(fit, motions.showing(seen))
        hidden = [i for i, name in enumerate(motions.channels.names) if name not in seen]
        off = [(f.path - v)[:, hidden] for f, v in zip(found, motions.values, strict=True)]
        shares = np.sqrt((np.array(off) ** 2).mean(1)) / motions.channels.spans[hidden]
        each = np.sqrt((shares**2).mean(1))
        figures = (float(np.median(each)), float(each.max()), float(shares.max()))
        table.add_row(
            f"{len(seen)} of {JOINTS}: {', '.join(seen)}",
            *(f"{figure:.1%}" for figure in figures),
            "met" if each.max() <= HIDDEN else f"{(each <= HIDDEN).sum()} of {len(each)}",
        )
    console.print(table)


def tell_command(console: Console, learned: mo.Motions, fit: mo.Fit, command: Time) -> None:
    """Print how long the command took and how good its model is, generated afresh."""
    first = np.stack([v[0] for v in learned.values])
    paths = mo.generate(fit.network, fit.initial_states, ROWS, first=first)
    shares = (paths - np.stack(learned.values))[:, 1:] / learned.channels.spans
    each = np.sqrt((shares**2).mean((1, 2)))
    error = float(np.sqrt((shares**2).mean()))
    title = f"motionese train: {EPISODES} × {ROWS} × {JOINTS}, {SETTINGS.epochs} epochs"
    table = Table(title=title)
    for heading in ("", "measured", "target", ""):
        table.add_column(heading, justify="right" if table.columns else "left")
    verdicts = ("missed", "met")
    table.add_row(
        "from CSV to model, nothing compiled, wall [s]",
        f"{command.wall:.1f}",
        f"< {SECONDS:g}",
        verdicts[command.wall < SECONDS],
    )
    table.add_row("  of the processor [s]", f"{command.processor:.1f}")
    table.add_row(
        f"closed-loop error, {len(learned)} learned motions",
        f"{error:.1%}",
        f"≤ {CLOSED_LOOP:.0%}",
        verdicts[error <= CLOSED_LOOP],
    )
    table.add_row("  the worst of them", f"{each.max():.1%}")
    table.add_row(
        f"  {len(fit.validation_names)} held-out motions, recognised",
        f"{fit.share(fit.validation_error):.1%}",
    )
    console.print(table)
    console.print(load())


def load() -> str:
    """Tell how busy the machine is, where that is known."""
    busy = f"{os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else "not known"
    return f"Load average {busy} on {os.cpu_count()} cores."


def main() -> None:
    """Write the recordings, train, compare, recognise."""
    console = Console(markup=False, highlight=False)
    with tempfile.TemporaryDirectory() as name:
        source, model = Path(name) / "episodes.csv", Path(name) / "robot.safetensors"
        write_recordings(source)
        command = train_by_command(source, model)
        fit = mo.load(model)
        learned = mo.Motions.read(source).chosen(fit.names)
    tell_command(console, learned, fit, command)
    compare(console, learned, fit, command)
    recognise(console, learned, fit)


if __name__ == "__main__":
    main()
