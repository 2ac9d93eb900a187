"""Imitation while watching: its error by the lag, and the belief when a demonstration turns."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy import ndarray

from motionese.analysis.curves import Looks
from motionese.analysis.statistics import estimate
from motionese.analysis.style import light_grid
from motionese.figure_style import FAINT, INK, WIDTH
from motionese.runtime import NONE

KINDS = {True: "sequences of the last lesson", False: "new sequences"}
AT_ONCE = 8
"""A change that is noticed within so many rows counts as noticed at once."""


def following(online: pd.DataFrame, looks: Looks) -> Figure:
    """Draw the error against the lag, and beside it that of recognition after the fact."""
    kinds = [kind for kind in KINDS if (online["taught"] == kind).any()]
    figure = Figure(figsize=(WIDTH, 3.4))
    panels = figure.subplots(1, len(kinds), sharey=True, squeeze=False)[0]
    lags = sorted(online["lag"].unique())
    for axes, kind in zip(panels, kinds, strict=True):
        own = online[online["taught"] == kind]
        for place, (name, look) in enumerate(looks.items()):
            rows = own[own["condition"] == name]
            shift = 0.12 * (place - (len(looks) - 1) / 2)
            columns = [rows[rows["lag"] == lag] for lag in lags]
            found = [_over_seeds(column, "imitation_error_cm") for column in columns]
            found.append(_over_seeds(rows, "after_the_fact_error_cm"))
            middle, low, high = np.array(found).T
            x = np.array([*range(len(lags)), len(lags) + 0.5]) + shift
            axes.vlines(x, low, high, color=look.colour, linewidth=1.2)
            axes.plot(x[:-1], middle[:-1], **look.curve(), label=name)
            axes.plot(x[-1:], middle[-1:], **{**look.curve(), "linestyle": "none"})
        axes.axvline(len(lags) - 0.25, color=FAINT, linewidth=0.8, linestyle=":")
        names = [*(str(lag) for lag in lags), "after\nthe fact"]
        axes.set_xticks([*range(len(lags)), len(lags) + 0.5], names)
        axes.set(title=KINDS[kind], xlabel="lag behind what is shown [rows]")
        axes.set_ylim(bottom=0)
        light_grid(axes)
    panels[0].set_ylabel("imitation error [cm]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=4, loc="outside upper center")
    return figure


def _over_seeds(rows: pd.DataFrame, column: str) -> tuple[float, float, float]:
    by_seed = rows.groupby("seed")[column].mean()
    found = estimate(by_seed.to_numpy(dtype=float))
    return found.value, found.low, found.high


def noticing(
    kept: Mapping[str, Mapping[str, ndarray]], turns: pd.DataFrame, looks: Looks, rate_hz: float
) -> Figure:
    """Draw the belief against time for one demonstration that turns, a panel a condition.

    Args:
        kept: What was kept of each condition's run: `belief.NAME` [T], `switch` (row, steps).
        turns: The row of each condition's turn in the table of switches, by condition.
        looks: How each condition is drawn.
        rate_hz: Rows per second [Hz].
    """
    figure = Figure(figsize=(WIDTH, 0.6 + 1.55 * len(kept)))
    panels = figure.subplots(len(kept), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, (name, arrays) in zip(panels, kept.items(), strict=True):
        first, second = (str(turns.loc[name, which]) for which in ("first", "second"))
        beliefs = {n.removeprefix("belief."): b for n, b in arrays.items() if "belief." in n}
        others = [b for n, b in beliefs.items() if n not in (first, second, NONE)]
        shown = {
            first: (beliefs[first], {"color": looks[name].colour}),
            second: (beliefs[second], {"color": INK}),
            "other motions": (sum(others, np.zeros(len(beliefs[first]))), {"color": FAINT}),
            NONE: (beliefs[NONE], {"color": FAINT, "linestyle": ":"}),
        }
        for label, (belief, look) in shown.items():
            axes.plot(np.arange(len(belief)) / rate_hz, belief, label=label, **look)
        _mark_turn(axes, arrays["switch"], rate_hz)
        axes.set_title(f"{name}: {first} turns into {second}", fontsize=9, loc="left")
        axes.set(ylabel="belief", ylim=(-0.03, 1.03))
        axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
        light_grid(axes)
    panels[-1].set_xlabel("time [s]")
    return figure


def _mark_turn(axes: Axes, switch: ndarray, rate_hz: float) -> None:
    row, steps = switch
    axes.axvline(row / rate_hz, color=INK, linewidth=1.0)
    if np.isfinite(steps):
        axes.axvline((row + steps) / rate_hz, color=INK, linewidth=1.0, linestyle="--")
        axes.annotate(
            f"{steps:.0f} rows", ((row + steps) / rate_hz, 0.5), xytext=(3, 0),
            textcoords="offset points", fontsize=8, va="center",
        )  # fmt: skip
