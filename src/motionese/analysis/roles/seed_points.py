"""Medians over seeds with their intervals, by condition; and single runs as points."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from motionese.analysis.curves import Looks
from motionese.analysis.statistics import estimate
from motionese.analysis.style import Look, light_grid
from motionese.figure_style import INK, PAPER

APART = 0.19
"""How far conditions are apart [columns]."""
SPREAD = 0.12
"""Width over which runs of one value are laid out [columns]."""
YOURS = "your runs"


def draw_columns(
    axes: Axes,
    table: pd.DataFrame,
    looks: Looks,
    columns: Mapping[str, str],
    yours: pd.DataFrame | None = None,
) -> None:
    """Draw some measures side by side, and in each of them the conditions.

    A condition's median and 95 % interval are those of `table`. Points are single runs: those of
    `yours` where there are any, else those of `table`.

    Args:
        axes: Where to draw.
        table: A row per condition and seed.
        looks: How each condition is drawn.
        columns: What is written below each measure, by its column in the tables.
        yours: The same of other runs.
    """
    shown = {name: look for name, look in looks.items() if name in set(table["condition"])}
    for place, column in enumerate(columns):
        for k, (name, look) in enumerate(shown.items()):
            x = place + APART * (k - (len(shown) - 1) / 2)
            _interval(axes, x, _values(table, name, column), look, faint=yours is not None)
            _points(axes, x, _values(table if yours is None else yours, name, column), look, yours)
    axes.set_xticks(range(len(columns)), list(columns.values()))
    axes.tick_params(axis="x", length=0)
    axes.set_xlim(-0.55, len(columns) - 0.45)
    light_grid(axes)


def legend(figure: Figure, looks: Looks, yours: pd.DataFrame | None = None) -> None:
    """Name the conditions above a figure, and whose runs the points are."""
    handles = [
        Line2D([], [], **{**look.curve(), "linestyle": "none"}, markersize=7, label=name)
        for name, look in looks.items()
    ]
    if yours is not None:
        point: dict[str, Any] = {
            "linestyle": "none",
            "marker": "o",
            "markerfacecolor": PAPER,
            "color": INK,
        }
        handles.append(Line2D([], [], **point, label=YOURS))
    figure.legend(handles=handles, ncols=len(handles), loc="outside upper center")


def _values(table: pd.DataFrame, condition: str, column: str) -> "pd.Series[float]":
    return table.loc[table["condition"] == condition, column].dropna().astype(float)


def _interval(axes: Axes, x: float, values: "pd.Series[float]", look: Look, *, faint: bool) -> None:
    found = estimate(values.to_numpy(dtype=np.float64))
    paint: dict[str, Any] = {"color": look.colour, "alpha": 0.55 if faint else 1.0, "zorder": 2}
    axes.plot([x, x], [found.low, found.high], linewidth=2.2, solid_capstyle="butt", **paint)
    filled = look.colour if look.line == "-" else PAPER
    axes.plot(x, found.value, marker=look.marker, markersize=7, markerfacecolor=filled, **paint)


def _points(
    axes: Axes, x: float, values: "pd.Series[float]", look: Look, yours: pd.DataFrame | None
) -> None:
    """Draw runs, those of one value side by side."""
    alike = values.round(2)
    within = alike.groupby(alike).cumcount() - (alike.groupby(alike).transform("count") - 1) / 2
    step = min(SPREAD / max(float(within.abs().max() or 0.0) * 2, 1.0), 0.03) if len(values) else 0
    paint: dict[str, Any] = {"markersize": 2.2, "color": look.colour, "alpha": 0.35, "zorder": 1}
    if yours is not None:
        paint = {"markersize": 4.2, "color": INK, "markerfacecolor": PAPER, "zorder": 3}
    axes.plot(x + within * step, values, linestyle="none", marker="o", **paint)
