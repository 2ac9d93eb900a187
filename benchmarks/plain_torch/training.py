"""The training of the library in plain PyTorch: eager, with its own autograd and Adam.

The same equations are written in three ways: with a Linear for every link between levels, with
one weight matrix as the equations read, and with all that can be computed before the loop taken
out of it. All start from the same weights and initial states, take the same steps (joint clip,
cosine schedule, bound), and come to the same losses.
"""

from collections.abc import Callable
from math import cos, pi

import numpy as np
import torch
from torch import Tensor, nn

import motionese as mo

SIZES, TAUS = (8, 40, 8), (2.0, 5.0, 70.0)
"""Units and time constants [steps] of IO and the context levels."""
IO, CONTEXT = SIZES[0], sum(SIZES[1:])
SETTINGS = mo.Training()


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
        self.context = torch.zeros(len(motions), CONTEXT, requires_grad=True)

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
        x = torch.cat([share * row + (1 - share) * y[:, :IO], y[:, IO:]], 1)
        u = (1 - data.rate) * u + data.rate * torch.addmm(data.bias, x, weights.T)
        predicted.append(u[:, :IO])
        share = SETTINGS.teacher_forcing
    return data.error(predicted)


def out_of_the_loop(data: Data) -> Tensor:
    """The same, four operations a step."""
    share = torch.full((len(data.sensed), 1, 1), SETTINGS.teacher_forcing)
    share[0] = 1.0
    wider = (0, CONTEXT)
    drive = nn.functional.pad(share * data.sensed, wider)
    gate = nn.functional.pad((1 - share).expand(-1, 1, IO), wider, value=1.0)
    scaled = (data.rate[:, None] * data.mask * data.weights).T
    offset, kept, predicted = data.rate * data.bias, 1 - data.rate, []
    u = torch.cat([torch.logit(data.sensed[0]), data.context], 1)
    for drive_t, gate_t in zip(drive[:-1].unbind(), gate[:-1].unbind(), strict=True):
        x = torch.addcmul(drive_t, gate_t, torch.sigmoid(u))
        u = torch.addcmul(torch.addmm(offset, x, scaled), kept, u)
        predicted.append(u[:, :IO])
    return data.error(predicted)


def epoch_of(loss: Callable[[], Tensor], weights: list[Tensor], context: Tensor) -> Callable:
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


def epochs_in_torch(network: mo.MTRNN, motions: mo.Motions) -> dict[str, Callable[[], float]]:
    """Return an epoch of each way of writing the training."""
    levels, *others = (Data(network, motions) for _ in range(3))
    cell = ByLevels(levels)
    epochs = {"by link": epoch_of(cell.loss, list(cell.parameters()), levels.context)}
    ways = {
        "one matrix": as_equations_read,
        "lean": out_of_the_loop,
    }
    for (name, loss), data in zip(ways.items(), others, strict=True):
        weights = [data.weights, data.bias]
        epochs[name] = epoch_of(lambda f=loss, d=data: f(d), weights, data.context)
    return epochs
