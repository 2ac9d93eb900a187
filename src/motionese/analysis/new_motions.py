"""Imitation of motions that were never taught as a whole (Fig. 9): a point per seed."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from motionese.analysis.measures import Measures
from motionese.analysis.statistics import estimate
from motionese.analysis.style import FAINT, INK, LOOKS, PAPER, WIDTH, light_grid
from motionese.experiment.conditions import Condition

SPREAD = 0.18
"""Width over which the seeds of a column are laid out [columns]."""
BESIDE = 0.15
"""How far to their right median and interval stand [columns]."""


def new_motions(measures: Measures, conditions: tuple[Condition, ...]) -> Figure:
    """Draw trained against untrained triples, a column per condition, seeds joined by a line."""
    figure = Figure(figsize=(WIDTH, 4.2))
    axes = figure.subplots()
    names = [c.name for c in conditions]
    groups = ((measures.trained_error, -0.21), (measures.untrained_error, 0.21))
    for place, name in enumerate(names):
        trained, untrained = (table[name] for table, _ in groups)
        seeds = trained.index.union(untrained.index)
        shift = np.linspace(-SPREAD / 2, SPREAD / 2, len(seeds)) if len(seeds) > 1 else [0.0]
        for seed, dx in zip(seeds, shift, strict=True):
            pair = [trained.get(seed, np.nan), untrained.get(seed, np.nan)]
            x = [place + offset + dx for _, offset in groups]
            axes.plot(x, pair, color=FAINT, linewidth=0.6, alpha=0.6, zorder=1)
        for table, offset in groups:
            _column(axes, table[name], place + offset, shift, name)
    labels = [f"{kind}\n" for _ in names for kind in ("trained", "untrained")]
    axes.set_xticks([p + o for p in range(len(names)) for _, o in groups], labels)
    for place, name in enumerate(names):
        axes.annotate(
            name, (place, 0), xycoords=("data", "axes fraction"), xytext=(0, -24),
            textcoords="offset points", ha="center", va="top", fontweight="bold",
        )  # fmt: skip
    axes.tick_params(axis="x", length=0)
    axes.set(ylabel="imitation error [cm]", xlim=(-0.6, len(names) - 0.4))
    axes.set_ylim(bottom=0)
    light_grid(axes)
    return figure


def _column(axes: Axes, values: "pd.Series[float]", x: float, shift: object, name: str) -> None:
    look = LOOKS[name]
    places = x + np.asarray(shift)
    axes.plot(
        places, values, linestyle="none", marker=look.marker, color=look.colour,
        markerfacecolor=look.colour if look.line == "-" else PAPER, markersize=5, zorder=3,
    )  # fmt: skip
    middle = estimate(values.to_numpy(dtype=np.float64))
    axes.plot([x + BESIDE] * 2, [middle.low, middle.high], color=INK, linewidth=1.2, zorder=4)
    axes.plot(
        x + BESIDE, middle.value, marker="_", color=INK, markersize=11, markeredgewidth=2.4,
        zorder=4,
    )  # fmt: skip
