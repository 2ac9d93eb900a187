"""Imitation of sequences that were never taught as a whole (Fig. 9): a point per seed."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from motionese.analysis.curves import Looks
from motionese.analysis.seed_measures import Measures
from motionese.analysis.statistics import estimate
from motionese.analysis.style import Look, light_grid
from motionese.figure_style import FAINT, INK, PAPER, WIDTH

SPREAD = 0.18
"""Width over which the seeds of a column are laid out [columns]."""
BESIDE = 0.15
"""How far to their right median and interval stand [columns]."""


def new_sequences(measures: Measures, looks: Looks) -> Figure:
    """Draw trained against untrained sequences, a column per condition, seeds joined by a line.

    Where all are of one kind there is nothing to join.
    """
    figure = Figure(figsize=(WIDTH, 4.2))
    axes = figure.subplots()
    kinds = {"trained": measures.trained_error, "untrained": measures.untrained_error}
    shown = {kind: table for kind, table in kinds.items() if table.notna().any(axis=None)}
    places = [-0.21, 0.21] if len(shown) == 2 else [0.0]
    groups = list(zip(shown.values(), places, strict=True))
    for place, (name, look) in enumerate(looks.items()):
        seeds = sorted({seed for table, _ in groups for seed in table[name].dropna().index})
        shift = np.linspace(-SPREAD / 2, SPREAD / 2, len(seeds)) if len(seeds) > 1 else [0.0]
        for seed, dx in zip(seeds, shift, strict=False):
            x = [place + offset + dx for _, offset in groups]
            values = [table[name].get(seed, np.nan) for table, _ in groups]
            axes.plot(x, values, color=FAINT, linewidth=0.6, alpha=0.6, zorder=1)
        for table, offset in groups:
            _column(axes, table[name].reindex(seeds), place + offset, shift, look)
    ticks = [p + o for p in range(len(looks)) for _, o in groups]
    axes.set_xticks(ticks, [f"{kind}\n" for _ in looks for kind in shown])
    for place, name in enumerate(looks):
        axes.annotate(
            name, (place, 0), xycoords=("data", "axes fraction"), xytext=(0, -24),
            textcoords="offset points", ha="center", va="top", fontweight="bold",
        )  # fmt: skip
    axes.tick_params(axis="x", length=0)
    axes.set(ylabel="imitation error [cm]", xlim=(-0.6, len(looks) - 0.4))
    axes.set_ylim(bottom=0)
    light_grid(axes)
    return figure


def _column(axes: Axes, values: "pd.Series[float]", x: float, shift: object, look: Look) -> None:
    places = x + np.asarray(shift)
    axes.plot(
        places, values, linestyle="none", marker=look.marker, color=look.colour,
        markerfacecolor=look.colour if look.line == "-" else PAPER, markersize=5, zorder=3,
    )  # fmt: skip
    middle = estimate(values.to_numpy(dtype=np.float64))
    axes.plot([x + BESIDE] * 2, [middle.low, middle.high], color=INK, linewidth=1.2, zorder=4)
    (bar,) = axes.plot(x + BESIDE, middle.value, marker="_", color=INK, markersize=11, zorder=4)
    bar.set_markeredgewidth(2.4)
