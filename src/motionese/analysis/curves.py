"""What happens over the loops: imitation error (Fig. 8), where it comes from, buttons pressed."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from motionese.analysis.claims import CONVERGED_CM
from motionese.analysis.statistics import estimate
from motionese.analysis.style import FAINT, LOOKS, WIDTH, light_grid
from motionese.experiment.conditions import Condition

SOURCES = {
    "recognition_residual_cm": "Recognition residual\n(understood − shown)",
    "model_error_cm": "Model error\n(performed − predicted)",
    "reproduction_error_cm": "Reproduction error\n(learned − performed)",
}
EVERY = 3
"""A marker on every so many loops."""


def course(loops: pd.DataFrame, condition: Condition, column: str) -> pd.DataFrame:
    """Return the median over seeds of each loop's mean over motions, with its 95 % interval."""
    own = loops[loops["condition"] == condition.name]
    by_loop = own.groupby(["loop", "seed"])[column].mean().unstack("seed")
    estimates = [estimate(row) for row in by_loop.to_numpy(dtype=np.float64)]
    rows = [(e.value, e.low, e.high) for e in estimates]
    return pd.DataFrame(rows, index=by_loop.index, columns=["value", "low", "high"])


def learning_curves(loops: pd.DataFrame, conditions: tuple[Condition, ...]) -> Figure:
    """Draw the imitation error over the loops, one curve a condition."""
    figure = Figure(figsize=(WIDTH, 4.4))
    axes = figure.subplots()
    for condition in conditions:
        _draw_course(axes, course(loops, condition, "imitation_error_cm"), condition)
    axes.set_yscale("log")
    axes.axhline(CONVERGED_CM, color=FAINT, linewidth=0.8, linestyle=":")
    axes.annotate(
        "converged: within a button's radius", (loops["loop"].max() + 0.4, CONVERGED_CM),
        xytext=(0, 2), textcoords="offset points", ha="right", va="bottom", color=FAINT, fontsize=8,
    )  # fmt: skip
    _mark_phases(axes, loops, named=True)
    _plain_log(axes)
    axes.set(xlabel="imitation loop", ylabel="imitation error [cm], log scale")
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.04))
    return figure


def error_sources(loops: pd.DataFrame, conditions: tuple[Condition, ...]) -> Figure:
    """Draw what the imitation error is made of over the loops."""
    figure = Figure(figsize=(WIDTH, 3.3))
    panels = figure.subplots(1, len(SOURCES), sharex=True, sharey=True)
    for axes, (column, title) in zip(panels, SOURCES.items(), strict=True):
        for condition in conditions:
            _draw_course(axes, course(loops, condition, column), condition)
        axes.set_yscale("log")
        _mark_phases(axes, loops)
        _plain_log(axes)
        axes.set(title=title, xlabel="imitation loop")
    panels[0].set_ylabel("error [cm], log scale")
    for axes in panels[1:]:
        axes.tick_params(labelleft=False)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=4, loc="outside upper center")
    return figure


def buttons_pressed(loops: pd.DataFrame, conditions: tuple[Condition, ...]) -> Figure:
    """Draw the share of due presses that were made, all seeds and motions of a loop together."""
    figure = Figure(figsize=(WIDTH, 3.3))
    axes = figure.subplots()
    for condition in conditions:
        own = loops[loops["condition"] == condition.name]
        counts = own.groupby("loop")[["buttons_due", "buttons_pressed"]].sum()
        share = 100 * counts["buttons_pressed"] / counts["buttons_due"].where(lambda n: n > 0)
        look = LOOKS[condition.name].curve()
        axes.plot(share.index, share, **look, markevery=EVERY, label=condition.name)
    axes.axhline(90, color=FAINT, linewidth=0.8, linestyle=":")
    _mark_phases(axes, loops)
    light_grid(axes)
    axes.set(xlabel="imitation loop", ylabel="due presses that were made [%]", ylim=(-3, 103))
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    return figure


def _draw_course(axes: Axes, curve: pd.DataFrame, condition: Condition) -> None:
    look = LOOKS[condition.name]
    axes.fill_between(
        curve.index, curve["low"], curve["high"], color=look.colour, alpha=0.16, linewidth=0
    )
    axes.plot(curve.index, curve["value"], **look.curve(), markevery=EVERY, label=condition.name)


def _mark_phases(axes: Axes, loops: pd.DataFrame, *, named: bool = False) -> None:
    """Mark the change from phase 1 to phase 2, if there is one."""
    last = loops["loop"].max()
    axes.set_xlim(0.5, last + 0.5)
    first = loops.loc[loops["phase"] == 1, "loop"].max()
    if not (first < last):
        return
    axes.axvline(first + 0.5, color=FAINT, linewidth=1.0)
    if named:
        for x, text in (((first + 1) / 2, "phase 1"), ((first + 1 + last) / 2, "phase 2")):
            axes.annotate(
                text, (x, 1.0), xycoords=("data", "axes fraction"), ha="center", va="bottom",
                color=FAINT,
            )  # fmt: skip


def _plain_log(axes: Axes) -> None:
    """Label a logarithmic axis with plain numbers at 1, 2, 5."""
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    light_grid(axes)
