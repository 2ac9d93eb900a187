"""The order, decoded from each level over the time of a motion."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from motionese.analysis.curves import Looks
from motionese.analysis.statistics import estimate
from motionese.analysis.style import light_grid
from motionese.figure_style import FAINT, WIDTH

EVERY = 4
"""A marker on every so many rows."""


def order_decoded(
    decoding: pd.DataFrame,
    looks: Looks,
    levels: Mapping[str, str],
    rate_hz: float,
    branching: int | None,
) -> Figure:
    """Draw the score of decoders of the order against time, a panel a level.

    Args:
        decoding: A row per run, level, what is decoded and row of time.
        looks: How each condition is drawn.
        levels: The panels' titles by level.
        rate_hz: Rows per second [Hz].
        branching: The row in which the first ambiguous stroke begins.
    """
    order = decoding[(decoding["what"] == "order") & decoding["row"].notna()]
    figure = Figure(figsize=(WIDTH, 3.4))
    panels = figure.subplots(1, len(levels), sharex=True, sharey=True, squeeze=False)[0]
    for axes, (level, title) in zip(panels, levels.items(), strict=True):
        own = order[order["level"] == level]
        for name, look in looks.items():
            rows = own[own["condition"] == name].groupby("row")["score"]
            found = np.array([estimate(v.to_numpy(dtype=float))[:3] for _, v in rows])
            if len(found):
                time = np.array([row for row, _ in rows], dtype=float) / rate_hz
                axes.fill_between(time, *found.T[1:], color=look.colour, alpha=0.16, linewidth=0)
                axes.plot(time, found[:, 0], **look.curve(), markevery=EVERY, label=name)
        chance = order.groupby("row")["chance"].mean()
        axes.plot(chance.index / rate_hz, chance, color=FAINT, linewidth=0.9, linestyle=":")
        if branching is not None:
            axes.axvline(branching / rate_hz, color=FAINT, linewidth=1.0)
        axes.set(title=title, xlabel="time [s]", ylim=(-0.03, 1.05))
        light_grid(axes)
        _name(axes, (0.0, float(chance.iloc[0])), "chance", (3, 3))
        if branching is not None:
            _name(axes, (branching / rate_hz, 0.0), "motions branch", (4, 3))
    panels[0].set_ylabel("order told right [share]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=max(len(handles), 1), loc="outside upper center")
    return figure


def _name(axes: Axes, at: tuple[float, float], text: str, offset: tuple[int, int]) -> None:
    axes.annotate(
        text, at, xytext=offset, textcoords="offset points", color=FAINT, fontsize=8, va="bottom"
    )
