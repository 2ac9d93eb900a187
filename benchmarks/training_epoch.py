"""One training epoch at the paper's size, here and in plain PyTorch, in the same run.

An epoch is the gradient of equation (3) over all motions and one update by Adam of the weights,
the bias and the initial states: 6 IO, 40 Cf and 2 Cs units, 9 motions of 80 steps, on one core.
PyTorch runs the same equations written compactly, eager, with its own autograd and Adam; both start
from the same weights and must come to the same losses. Times are of the processor, so that what
else runs on the machine counts as little as possible.

    python benchmarks/training_epoch.py
"""

import os
import sys
from time import process_time

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["OMP_NUM_THREADS"] = "1"

import jax
import numpy as np
from rich.console import Console
from rich.table import Table

from motionese import MTRNN, Level, Motions, Training, train

try:
    import torch
except ImportError:
    sys.exit("this benchmark compares with PyTorch: pip install torch")

SIZES, TAUS, MOTIONS, STEPS = (6, 40, 2), (2.0, 5.0, 70.0), 9, 80
SETTINGS = Training(
    optimiser="adam",
    weight_rate=3e-3,
    initial_rate=1e-2,
    schedule="constant",
    clip=0.0,
    bound={},
    teacher_forcing=0.3,
)
EPOCHS, EPOCHS_IN_TORCH, ROUNDS = Training().epochs, 30, 5
TARGET = 20.0


def curves() -> Motions:
    """Smooth random motions over as many channels as IO units."""
    rng = np.random.default_rng(0)
    t = np.linspace(0.0, 2 * np.pi, STEPS)[:, None, None]
    waves = np.sin(t * rng.uniform(0.5, 2.0, (3, SIZES[0])) + rng.uniform(0, 6, (MOTIONS, 1, 3, 6)))
    return Motions.from_arrays(list(waves.mean(2)), [f"channel {i}" for i in range(6)], 10.0)


class InTorch:
    """Equations (1)–(5) in PyTorch, one training at a time."""

    def __init__(self, network: MTRNN, motions: Motions) -> None:
        level = np.repeat(np.arange(len(SIZES)), SIZES)
        self.mask = torch.tensor(np.abs(level[:, None] - level[None]) <= 1, dtype=torch.float32)
        self.rate = 1 / torch.tensor(np.array(network.tau))
        self.sensed = torch.tensor(np.array(motions.batch().sensed)).swapaxes(0, 1)
        self.weights = torch.tensor(np.array(network.weights), requires_grad=True)
        self.bias = torch.tensor(np.array(network.bias), requires_grad=True)
        self.context = torch.zeros(MOTIONS, sum(SIZES[1:]), requires_grad=True)
        self.rule = torch.optim.Adam(
            [
                {"params": [self.weights, self.bias], "lr": SETTINGS.weight_rate},
                {"params": [self.context], "lr": SETTINGS.initial_rate},
            ]
        )

    def loss(self) -> torch.Tensor:
        """Equation (3)."""
        io, weights = SIZES[0], self.mask * self.weights
        u = torch.cat([torch.logit(self.sensed[0]), self.context], 1)
        share, predicted = 1.0, []
        for row in self.sensed[:-1]:
            y = torch.sigmoid(u)
            x = torch.cat([share * row + (1 - share) * y[:, :io], y[:, io:]], 1)
            u = (1 - self.rate) * u + self.rate * torch.addmm(self.bias, x, weights.T)
            predicted.append(u[:, :io])
            share = SETTINGS.teacher_forcing
        return ((torch.sigmoid(torch.stack(predicted)) - self.sensed[1:]) ** 2).sum()

    def epoch(self) -> float:
        """Take one gradient and one update; return the loss before it."""
        self.rule.zero_grad()
        loss = self.loss()
        loss.backward()
        self.rule.step()
        return loss.item()


def milliseconds_here(network: MTRNN, motions: Motions) -> float:
    """Measure an epoch of `train`, with all that `train` does around its epochs."""
    began = process_time()
    train(network, motions, epochs=EPOCHS, settings=SETTINGS)
    return (process_time() - began) / EPOCHS * 1e3


def milliseconds_in_torch(model: InTorch) -> float:
    """Measure an epoch in PyTorch."""
    began = process_time()
    for _ in range(EPOCHS_IN_TORCH):
        model.epoch()
    return (process_time() - began) / EPOCHS_IN_TORCH * 1e3


def main() -> None:
    """Check that the losses agree, time both in turns, print the medians."""
    torch.set_num_threads(1)
    motions = curves()
    levels = [Level(size, tau) for size, tau in zip(SIZES, TAUS, strict=True)]
    network = MTRNN.draw(levels, key=jax.random.key(0))
    model = InTorch(network, motions)

    losses = train(network, motions, epochs=EPOCHS, settings=SETTINGS).losses[:10]
    in_torch = [model.epoch() for _ in range(10)]
    worst = float(np.max(np.abs(losses / in_torch - 1)))
    if worst > 1e-5:
        sys.exit(f"the losses of the first epochs differ by a share of {worst:.1e}, allowed 1e-5")

    turns = [
        (milliseconds_here(network, motions), milliseconds_in_torch(model)) for _ in range(ROUNDS)
    ]
    here, there = np.median(turns, axis=0)
    ratio = float(np.median([b / a for a, b in turns]))
    table = Table(title=f"One epoch: {'/'.join(map(str, SIZES))} units, {MOTIONS} × {STEPS} steps")
    for heading in ("", "ms per epoch", "times faster"):
        table.add_column(heading, justify="right")
    table.add_row(f"PyTorch {torch.__version__}, eager", f"{there:.2f}", "1.0")
    table.add_row("motionese", f"{here:.2f}", f"{ratio:.1f}")
    console = Console()
    console.print(table)
    console.print(
        f"Losses of the first 10 epochs agree to {worst:.0e}; "
        f"the target of {TARGET:g} times is {'met' if ratio >= TARGET else 'missed'}."
    )


if __name__ == "__main__":
    main()
