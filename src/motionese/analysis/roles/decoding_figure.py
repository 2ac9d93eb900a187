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
) -> Figure:
    """Draw the score of decoders of the order against time, a panel a level.

    Args:
        decoding: A row per run, level, what is decoded and row, counted from where ways part.
        looks: How each condition is drawn.
        levels: The panels' titles by level.
        rate_hz: Rows per second [Hz].
    """
    order = decoding[(decoding["what"] == "order") & decoding["row"].notna()]
    figure = Figure(figsize=(WIDTH, 3.4))
    panels = figure.subplots(1, len(levels), sharex=True, sharey=True, squeeze=False)[0]
    for axes, (level, title) in zip(panels, levels.items(), strict=True):
        own = order[order["level"] == level]
        for name, look in looks.items():
            rows = own[own["condition"] == name].groupby(["row", "seed"])["score"].mean()
            scores = rows.unstack("seed")
            found = np.array([estimate(v)[:3] for v in scores.to_numpy(dtype=np.float64)])
            if len(found):
                time = scores.index.to_numpy(dtype=np.float64) / rate_hz
                axes.fill_between(time, *found.T[1:], color=look.colour, alpha=0.16, linewidth=0)
                axes.plot(time, found[:, 0], **look.curve(), markevery=EVERY, label=name)
        chance = order.groupby("row")["chance"].mean()
        axes.plot(chance.index / rate_hz, chance, color=FAINT, linewidth=0.9, linestyle=":")
        axes.axvline(0.0, color=FAINT, linewidth=1.0)
        axes.set(title=title, xlabel="time since the ways part [s]", ylim=(-0.03, 1.05))
        light_grid(axes)
        _name(axes, (chance.index[0] / rate_hz, float(chance.iloc[0])), "chance", (0, -12))
        _name(axes, (0.0, 0.0), "the ways part", (4, 3))
    panels[0].set_ylabel("order told right [share]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=max(len(handles), 1), loc="outside upper center")
    return figure


def _name(axes: Axes, at: tuple[float, float], text: str, offset: tuple[int, int]) -> None:
    axes.annotate(
        text, at, xytext=offset, textcoords="offset points", color=FAINT, fontsize=8, va="bottom"
    )
