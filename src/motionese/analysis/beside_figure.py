"""Runs as points over what is usual among the kept ones, a panel a measure."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from jaxtyping import Float
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy import ndarray

from motionese.analysis.beside_kept import Beside, values_of
from motionese.analysis.style import Look
from motionese.figure_style import FAINT, INK, PAPER, WIDTH

PANELS = {
    "first_by_cf": "First stroke follows Cf₀",
    "order_by_cs": "Order follows Cs₀",
    "branch_without_cs": "Right branch, Cs₀ at its mean",
    "symbols_right": "Sequences read out right",
    "map_length_1": "Map: same first direction",
    "map_length_2": "Map: same second direction",
    "own_direction": "Map: own direction",
    "order_on_map": "Map: order",
    "end_of_stage_1_cm": "Error, end of stage 1 [cm]",
    "end_of_stage_2_cm": "Error, end of stage 2 [cm]",
    "untrained_cm": "New triples, long search [cm]",
    "untrained_repertoire_cm": "New triples, repertoire [cm]",
}
"""What is drawn, where there is anything of it."""
COLUMNS, SPREAD = 4, 0.36


def beside_figure(beside: Sequence[Beside], own: pd.DataFrame, looks: Mapping[str, Look]) -> Figure:
    """Draw a panel a measure, in which every condition has a row.

    Args:
        beside: As of `beside_kept`.
        own: The measures of the runs that are points, by condition and seed.
        looks: The conditions, from top to bottom.
    """
    measured = {each.measure for each in beside}
    present = [column for column in PANELS if column in measured]
    rows = -(-len(present) // COLUMNS)
    figure = Figure(figsize=(WIDTH, 0.5 + (0.6 + 0.24 * len(looks)) * rows))
    panels = figure.subplots(rows, COLUMNS, sharey=True, squeeze=False).ravel()
    for axes, column in zip(panels, present, strict=False):
        of = {each.condition: each for each in beside if each.measure == column}
        for place, (name, look) in enumerate(looks.items()):
            if name in of:
                _kept(axes, of[name], place, look)
            _points(axes, values_of(own, name, column), place, look)
        axes.set_title(PANELS[column], fontsize=8.5)
        if not column.endswith("_cm"):
            axes.set(xlim=(-0.06, 1.06), xticks=(0.0, 0.5, 1.0))
        axes.tick_params(axis="y", length=0)
        axes.grid(visible=True, axis="x")
        axes.set_axisbelow(True)
    for axes in panels[len(present) :]:
        axes.set_visible(False)
    panels[0].set_yticks(range(len(looks)), list(looks))
    panels[0].set_ylim(len(looks) - 0.5, -0.5)
    return figure


def _kept(axes: Axes, beside: Beside, place: int, look: Look) -> None:
    across, kept, butt = [place] * 2, beside.kept, "butt"
    axes.plot(beside.usual, across, color=FAINT, linewidth=7, alpha=0.25, solid_capstyle=butt)
    axes.plot([kept.low, kept.high], across, color=look.colour, linewidth=2.4, solid_capstyle=butt)
    axes.plot(kept.value, place, marker="|", color=INK, markersize=11, markeredgewidth=1.8)


def _points(axes: Axes, values: Float[ndarray, " n"], place: int, look: Look) -> None:
    shift = np.linspace(-SPREAD / 2, SPREAD / 2, len(values)) if len(values) > 1 else 0 * values
    axes.plot(
        values, place + shift, linestyle="none", marker=look.marker, color=look.colour,
        markerfacecolor=look.colour if look.line == "-" else PAPER, markersize=4.5,
        markeredgewidth=1.2, zorder=3,
    )  # fmt: skip
