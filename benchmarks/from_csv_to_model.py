"""From a CSV of recordings to a trained model, and the same training in plain PyTorch beside it.

The recordings: 30 episodes of 150 rows at 10 Hz, 8 joints [deg]. Every episode leaves a common rest
posture (off by 5 degrees or so) and reaches for 3 to 5 postures drawn from ±90 degrees, each in
a minimum-jerk movement of its own length, 2 s at least. No two episodes share a posture, so that
nothing learned from 27 of them foretells the other three: their error says how far the network can
be made to follow an unknown motion, not how well it generalises.

1. The command `motionese train`, as a user calls it, in a process of its own that finds nothing
   compiled: seconds from CSV to model, and the model's error in closed loop.
2. The same training in PyTorch, eager, with its own autograd and Adam, written in three ways, from
   the same weights and to the same losses: level by level with a Linear for every link, as cells
   are mostly written; as equations (1)–(3) read, with one weight matrix, as in `training_epoch.py`;
   and the same with all that can be computed before the loop taken out of it. 3,000 epochs would
   take minutes, so a few are timed in turns with ours, and scaled. Processor time counts what the
   threads do, so that what else runs on the machine counts as little as possible.
3. Recognition of the learned motions from a third of the channels.

    python benchmarks/from_csv_to_model.py
"""

import csv
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from math import cos, pi
from pathlib import Path
from time import perf_counter, process_time

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"

import jax
import numpy as np
from rich.console import Console
from rich.table import Table

import motionese as mo
from motionese.interfaces.held_out import split
from motionese.learning import recognise_all

try:
    import torch
    from torch import Tensor, nn
except ImportError:
    sys.exit("this benchmark compares with PyTorch: pip install torch")

EPISODES, ROWS, RATE_HZ, JOINTS = 30, 150, 10.0, 8
SIZES, TAUS = (JOINTS, 40, 8), (2.0, 5.0, 70.0)
SETTINGS, SEED = mo.Training(), 0
EPOCHS_HERE, TURNS = 600, 5
EPOCHS_IN_TORCH = {1: 30, torch.get_num_threads(): 10} | {1: 30}
"""How many epochs are timed in a turn, by number of threads: one, and PyTorch's default."""
SECONDS, CLOSED_LOOP, TIMES, HIDDEN, AGREE = 30.0, 0.03, 15.0, 0.05, 1e-4
"""Targets; and how far the losses of the first ten epochs may differ."""


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


def train_by_command(source: Path, out: Path) -> tuple[float, float]:
    """Run `motionese train` with nothing compiled; return seconds of wall and of processor."""
    variables = ("XLA_FLAGS", "OMP_NUM_THREADS", "JAX_COMPILATION_CACHE_DIR")
    environment = {k: v for k, v in os.environ.items() if k not in variables}
    environment["XDG_CACHE_HOME"] = str(out.parent / "cache")
    code = "from motionese.interfaces.command_line import main; main()"
    levels = ",".join(f"{s}:{t:g}" for s, t in zip(SIZES[1:], TAUS[1:], strict=True))
    command = [sys.executable, "-c", code, "train", str(source), "--out", str(out)]
    began, before = perf_counter(), os.times()
    ran = subprocess.run(
        [*command, "--levels", levels, "--seed", str(SEED)],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    wall, after = perf_counter() - began, os.times()
    if ran.returncode:
        sys.exit(f"motionese train failed: {ran.stderr or ran.stdout}")
    return wall, sum(after[2:4]) - sum(before[2:4])


def rate_of(epoch: int) -> float:
    """The cosine schedule: the rates of an epoch as a share of the largest."""
    rising = round(0.05 * SETTINGS.epochs)
    if epoch < rising:
        return 0.1 + 0.9 * epoch / rising
    fallen = (epoch - rising) / (SETTINGS.epochs - rising)
    return 0.01 + 0.99 * (1 + cos(pi * fallen)) / 2


class Data:
    """What every way of writing it in PyTorch starts from, time first."""

    def __init__(self, network: mo.MTRNN, motions: mo.Motions) -> None:
        self.sensed = torch.tensor(np.array(motions.batch().sensed)).swapaxes(0, 1).contiguous()
        level = np.repeat(np.arange(len(SIZES)), SIZES)
        self.mask = torch.tensor(np.abs(level[:, None] - level[None]) <= 1, dtype=torch.float32)
        self.rate = 1 / torch.tensor(np.array(network.tau))
        self.weights = torch.tensor(np.array(network.weights), requires_grad=True)
        self.bias = torch.tensor(np.array(network.bias), requires_grad=True)
        self.context = torch.zeros(len(motions), sum(SIZES[1:]), requires_grad=True)

    def error(self, potentials: list[Tensor]) -> Tensor:
        """Equation (3)."""
        return ((torch.sigmoid(torch.stack(potentials)) - self.sensed[1:]) ** 2).sum()


class ByLevels(nn.Module):
    """Equations (1) and (2), a Linear for every link between levels."""

    def __init__(self, data: Data) -> None:
        super().__init__()
        self.data, self.links = data, nn.ModuleDict()
        weights = torch.split(data.weights.detach(), SIZES)
        for i, j in ((i, j) for i in range(3) for j in range(3) if abs(i - j) <= 1):
            link = nn.Linear(SIZES[j], SIZES[i], bias=i == j)
            link.weight.data = torch.split(weights[i], SIZES, 1)[j].clone()
            if i == j:
                nn.init.zeros_(link.bias)
            self.links[f"{j} to {i}"] = link

    def forward(self, x: Tensor, u: list[Tensor]) -> list[Tensor]:
        """Take one step, from the input of IO and the potentials of all levels."""
        y = [x, *(torch.sigmoid(level) for level in u[1:])]
        near = [[j for j in range(3) if abs(i - j) <= 1] for i in range(3)]
        summed = [sum(self.links[f"{j} to {i}"](y[j]) for j in near[i]) for i in range(3)]
        return [(1 - 1 / t) * u[i] + summed[i] / t for i, t in enumerate(TAUS)]

    def loss(self) -> Tensor:
        """Equation (3)."""
        data, share, predicted = self.data, 1.0, []
        u = [torch.logit(data.sensed[0]), *torch.split(data.context, SIZES[1:], 1)]
        for row in data.sensed[:-1]:
            u = self(share * row + (1 - share) * torch.sigmoid(u[0]), u)
            predicted.append(u[0])
            share = SETTINGS.teacher_forcing
        return data.error(predicted)


def as_equations_read(data: Data) -> Tensor:
    """Equations (1)–(3), one weight matrix."""
    weights, share, predicted = data.mask * data.weights, 1.0, []
    u = torch.cat([torch.logit(data.sensed[0]), data.context], 1)
    for row in data.sensed[:-1]:
        y = torch.sigmoid(u)
        x = torch.cat([share * row + (1 - share) * y[:, :JOINTS], y[:, JOINTS:]], 1)
        u = (1 - data.rate) * u + data.rate * torch.addmm(data.bias, x, weights.T)
        predicted.append(u[:, :JOINTS])
        share = SETTINGS.teacher_forcing
    return data.error(predicted)


def out_of_the_loop(data: Data) -> Tensor:
    """The same, four operations a step."""
    share = torch.full((ROWS, 1, 1), SETTINGS.teacher_forcing)
    share[0] = 1.0
    wider = (0, sum(SIZES[1:]))
    drive = nn.functional.pad(share * data.sensed, wider)
    gate = nn.functional.pad((1 - share).expand(-1, 1, JOINTS), wider, value=1.0)
    scaled = (data.rate[:, None] * data.mask * data.weights).T
    offset, kept, predicted = data.rate * data.bias, 1 - data.rate, []
    u = torch.cat([torch.logit(data.sensed[0]), data.context], 1)
    for drive_t, gate_t in zip(drive[:-1].unbind(), gate[:-1].unbind(), strict=True):
        x = torch.addcmul(drive_t, gate_t, torch.sigmoid(u))
        u = torch.addcmul(torch.addmm(offset, x, scaled), kept, u)
        predicted.append(u[:, :JOINTS])
    return data.error(predicted)


def epochs_of(loss: Callable[[], Tensor], weights: list[Tensor], context: Tensor) -> Callable:
    """Return a function that takes one gradient and one update and returns the loss before it."""
    groups = [
        {"params": weights, "lr": SETTINGS.weight_rate},
        {"params": [context], "lr": SETTINGS.initial_rate},
    ]
    rule = torch.optim.Adam(groups)
    schedule = torch.optim.lr_scheduler.LambdaLR(rule, rate_of)

    def epoch() -> float:
        rule.zero_grad()
        value = loss()
        value.backward()
        nn.utils.clip_grad_norm_([*weights, context], SETTINGS.clip)
        rule.step()
        schedule.step()
        with torch.no_grad():
            context.clamp_(-SETTINGS.bound, SETTINGS.bound)
        return value.item()

    return epoch


def in_torch(network: mo.MTRNN, motions: mo.Motions) -> dict[str, Callable[[], float]]:
    """Return an epoch of each way of writing the training."""
    levels, *others = (Data(network, motions) for _ in range(3))
    cell = ByLevels(levels)
    epochs = {"by levels": epochs_of(cell.loss, list(cell.parameters()), levels.context)}
    ways = {"as the equations read": as_equations_read, "out of the loop": out_of_the_loop}
    for (name, loss), data in zip(ways.items(), others, strict=True):
        weights = [data.weights, data.bias]
        epochs[name] = epochs_of(lambda f=loss, d=data: f(d), weights, data.context)
    return epochs


def milliseconds(work: Callable[[], object], epochs: int) -> tuple[float, float]:
    """Return what an epoch takes of the processor and of the wall clock."""
    wall, processor = perf_counter(), process_time()
    work()
    return (process_time() - processor) / epochs * 1e3, (perf_counter() - wall) / epochs * 1e3


def compare(
    console: Console, motions: mo.Motions, fit: mo.Fit, command: tuple[float, float]
) -> None:
    """Check that PyTorch trains the same, time it in turns with ours, print the medians."""
    drawn, _ = jax.random.split(jax.random.key(SEED))
    levels = [mo.Level(size, tau) for size, tau in zip(SIZES, TAUS, strict=True)]
    network = mo.MTRNN(levels, key=drawn)
    ways, worst = in_torch(network, motions), 0.0
    torch.set_num_threads(1)
    for name, epoch in ways.items():
        off = np.max(np.abs([epoch() for _ in range(10)] / fit.losses[:10] - 1))
        if off > AGREE:
            sys.exit(f"PyTorch, {name}: the losses differ by a share of {off:.1e}")
        worst = max(worst, float(off))

    def here() -> mo.Fit:
        return mo.train(network, motions, epochs=EPOCHS_HERE)

    here()
    ours, theirs = [], {(name, n): [] for name in ways for n in EPOCHS_IN_TORCH}
    for _ in range(TURNS):
        ours.append(milliseconds(here, EPOCHS_HERE))
        for (name, threads), took in theirs.items():
            torch.set_num_threads(threads)
            n = EPOCHS_IN_TORCH[threads]
            took.append(milliseconds(lambda f=ways[name], n=n: [f() for _ in range(n)], n))

    table = Table(title=f"{SETTINGS.epochs} epochs of {len(motions)} motions, {TURNS} turns")
    for heading in ("", "threads", "processor [ms]", "wall [ms]", "all epochs, wall [s]"):
        table.add_column(heading, justify="right" if heading else "left")
    for heading in ("× processor", "× wall", f"≥ {TIMES:g}"):
        table.add_column(heading, justify="right")
    processor, wall = np.median(ours, axis=0)
    total = SETTINGS.epochs / 1e3
    table.add_row("motionese", "1", f"{processor:.2f}", f"{wall:.2f}", f"{wall * total:.1f}")
    whole = [seconds / total for seconds in command]
    table.add_row(
        "  the whole command", "1", f"{whole[1]:.2f}", f"{whole[0]:.2f}", f"{command[0]:.1f}"
    )
    for (name, threads), took in theirs.items():
        cost = np.median(took, axis=0)
        times = np.median(np.array(took) / np.array(ours), axis=0)
        # The threads' processor time adds up, so several are judged by the wall clock.
        judged = times[0] if threads == 1 else times[1]
        table.add_row(
            f"PyTorch, {name}",
            str(threads),
            *(f"{c:.2f}" for c in cost),
            f"{cost[1] * total:.0f}",
            *(f"{t:.1f}" for t in times),
            "met" if judged >= TIMES else "missed",
        )
    console.print(table)
    console.print(
        f"PyTorch {torch.__version__}, eager; an epoch each, PyTorch's 3,000 scaled from "
        f"{TURNS} × {EPOCHS_IN_TORCH[1]} epochs (default threads: {TURNS} × 10). The losses of the "
        f"first 10 epochs agree with the command's to {worst:.0e}."
    )


def recognise(console: Console, motions: mo.Motions, fit: mo.Fit) -> None:
    """Recognise the learned motions from every third channel, once the better third, once less."""
    table = Table(
        title=f"Recognition of the {len(motions)} learned motions, errors of hidden joints"
    )
    for heading in ("observed", "median", "worst motion", "worst joint of a motion", "≤ 5 %"):
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


def tell_command(
    console: Console, learned: mo.Motions, fit: mo.Fit, command: tuple[float, float]
) -> None:
    """Print how long the command took and how good its model is, generated afresh."""
    first = np.stack([v[0] for v in learned.values])
    paths = mo.generate(fit.network, fit.initial_states, ROWS, first=first)
    shares = (paths - np.stack(learned.values))[:, 1:] / learned.channels.spans
    each = np.sqrt((shares**2).mean((1, 2)))
    error = float(np.sqrt((shares**2).mean()))
    table = Table(
        title=f"motionese train: {EPISODES} × {ROWS} × {JOINTS}, {SETTINGS.epochs} epochs"
    )
    for heading in ("", "measured", "target", ""):
        table.add_column(heading, justify="right" if table.columns else "left")
    verdicts = ("missed", "met")
    table.add_row(
        "from CSV to model, nothing compiled, wall [s]",
        f"{command[0]:.1f}",
        f"< {SECONDS:g}",
        verdicts[command[0] < SECONDS],
    )
    table.add_row("  of the processor [s]", f"{command[1]:.1f}")
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
    if hasattr(os, "getloadavg"):
        console.print(f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


def main() -> None:
    """Write the recordings, train, compare, recognise."""
    console = Console()
    with tempfile.TemporaryDirectory() as name:
        source, model = Path(name) / "episodes.csv", Path(name) / "robot.safetensors"
        write_recordings(source)
        command = train_by_command(source, model)
        learned, _ = split(mo.Motions.read(source), None, SEED)
        fit = mo.load(model)
    tell_command(console, learned, fit, command)
    compare(console, learned, fit, command)
    recognise(console, learned, fit)


if __name__ == "__main__":
    main()
