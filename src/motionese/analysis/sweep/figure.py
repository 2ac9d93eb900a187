"""A sweep in one figure: a panel a measure, its medians over seeds from point to point."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from motionese.analysis.beside_figure import PANELS
from motionese.analysis.beside_kept import TITLES
from motionese.analysis.style import Look, light_grid
from motionese.figure_style import FAINT, WIDTH

COLUMNS, APART = 3, 0.08


def sweep_figure(
    table: pd.DataFrame, labels: Sequence[str], reference: str, looks: Mapping[str, Look]
) -> Figure:
    """Draw what `swept_effects` returns.

    Args:
        table: Medians with their intervals, by measure, condition and point.
        labels: The points, from left to right.
        reference: The point that is marked.
        looks: Of the conditions.
    """
    measures = list(dict.fromkeys(table["measure"]))
    rows = -(-len(measures) // COLUMNS)
    longest = max(map(len, labels))
    figure = Figure(figsize=(WIDTH, 0.5 + (1.7 + 0.055 * longest) * rows))
    panels = figure.subplots(rows, COLUMNS, squeeze=False).ravel()
    for axes, measure in zip(panels, measures, strict=False):
        own = table[table["measure"] == measure]
        axes.axvline(labels.index(reference), color=FAINT, linewidth=0.8, linestyle=":")
        _curves(axes, own, labels, looks)
        axes.set_title(PANELS.get(measure, TITLES.get(measure, measure)), fontsize=8.5)
        axes.set_xticks(range(len(labels)), labels, rotation=90, fontsize=7.5)
        if measure.endswith("_cm"):
            axes.set_ylim(bottom=0)
        else:
            axes.set(ylim=(-0.05, 1.05), yticks=(0.0, 0.5, 1.0))
        light_grid(axes)
    for axes in panels[len(measures) :]:
        axes.set_visible(False)
    if len(looks) > 1:
        figure.legend(*panels[0].get_legend_handles_labels(), loc="outside upper left", ncols=4)
    return figure


def _curves(
    axes: Axes, own: pd.DataFrame, labels: Sequence[str], looks: Mapping[str, Look]
) -> None:
    for place, (name, look) in enumerate(looks.items()):
        of = own[own["condition"] == name].set_index("point").reindex(pd.Index(labels))
        across = np.arange(len(labels)) + APART * (place - (len(looks) - 1) / 2)
        axes.plot(across, of["median"], label=name, **look.curve())
        axes.vlines(across, of["low"], of["high"], color=look.colour, linewidth=1.1)
