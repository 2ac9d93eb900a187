"""What happens over the loops: imitation error (Fig. 8), where it comes from, what is achieved."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter

from motionese.analysis.seed_measures import achieved
from motionese.analysis.statistics import estimate
from motionese.analysis.style import Look, light_grid
from motionese.figure_style import FAINT, WIDTH
from motionese.task import Outcome

SOURCES = {
    "recognition_residual_cm": "Recognition residual\n(understood − shown)",
    "model_error_cm": "Model error\n(performed − predicted)",
    "reproduction_error_cm": "Reproduction error\n(learned − performed)",
}
EVERY = 3
"""A marker on every so many loops."""

Looks = Mapping[str, Look]
"""The conditions that are drawn, in order, and how."""


def along_stages(loops: pd.DataFrame) -> pd.DataFrame:
    """Return the loops renumbered so that a stage begins in the same one in all runs.

    Where stages end after a number of loops that is where it began. Where they end when learning
    has settled, it is one after the longest run of the stage before.
    """
    first = loops.groupby(["condition", "seed", "phase"])["loop"].transform("min")
    within = loops["loop"] - first + 1
    lengths = within.groupby(loops["phase"]).max()
    before = lengths.cumsum() - lengths
    return loops.assign(loop=within + loops["phase"].map(before))


def course(loops: pd.DataFrame, condition: str, column: str) -> pd.DataFrame:
    """Return the median over seeds of each loop's mean over motions, with its 95 % interval."""
    own = loops[loops["condition"] == condition]
    by_loop = own.groupby(["loop", "seed"])[column].mean().unstack("seed")
    by_loop = by_loop.reindex(range(1, by_loop.index.max() + 1))
    estimates = [estimate(row) for row in by_loop.to_numpy(dtype=np.float64)]
    rows = [(e.value, e.low, e.high) for e in estimates]
    return pd.DataFrame(rows, index=by_loop.index, columns=["value", "low", "high"])


def learning_curves(loops: pd.DataFrame, looks: Looks, converged_cm: float | None) -> Figure:
    """Draw the imitation error over the loops (as of `along_stages`), one curve a condition.

    Where a run counts as converged from some error on, that bound is drawn too.
    """
    figure = Figure(figsize=(WIDTH, 4.4))
    axes = figure.subplots()
    draw_courses(axes, loops, looks, "imitation_error_cm")
    axes.set_yscale("log")
    if converged_cm is not None:
        axes.axhline(converged_cm, color=FAINT, linewidth=0.8, linestyle=":")
        axes.annotate(
            "converged: within a button's radius", (loops["loop"].max() + 0.4, converged_cm),
            xytext=(0, 2), textcoords="offset points", ha="right", va="bottom", color=FAINT,
            fontsize=8,
        )  # fmt: skip
    mark_stages(axes, loops, named=True)
    plain_log(axes)
    axes.set(xlabel="imitation loop", ylabel="imitation error [cm], log scale")
    axes.legend(ncols=4, loc="lower center", bbox_to_anchor=(0.5, 1.04))
    return figure


def error_sources(loops: pd.DataFrame, looks: Looks) -> Figure:
    """Draw what the imitation error is made of over the loops."""
    figure = Figure(figsize=(WIDTH, 3.3))
    panels = figure.subplots(1, len(SOURCES), sharex=True, sharey=True)
    for axes, (column, title) in zip(panels, SOURCES.items(), strict=True):
        draw_courses(axes, loops, looks, column)
        axes.set_yscale("log")
        mark_stages(axes, loops)
        plain_log(axes)
        axes.set(title=title, xlabel="imitation loop")
    panels[0].set_ylabel("error [cm], log scale")
    for axes in panels[1:]:
        axes.tick_params(labelleft=False)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=4, loc="outside upper center")
    return figure


def success(loops: pd.DataFrame, looks: Looks, outcomes: Sequence[Outcome]) -> Figure:
    """Draw what was achieved, all seeds and motions of a loop together, a panel an outcome."""
    figure = Figure(figsize=(WIDTH, 3.3))
    panels = figure.subplots(1, len(outcomes), sharex=True, squeeze=False)[0]
    for axes, outcome in zip(panels, outcomes, strict=True):
        by_loop = achieved(loops, outcome, index=("loop",)) * (100 if outcome.of else 1)
        for condition, look in looks.items():
            values = by_loop[condition].reindex(range(1, by_loop.index.max() + 1))
            axes.plot(values.index, values, **look.curve(), markevery=EVERY, label=condition)
        unit = "%" if outcome.of else outcome.unit
        axes.set(xlabel="imitation loop", ylabel=f"{outcome.title} [{unit}]")
        axes.set_ylim((-3, 103) if outcome.of else (0, None))
        mark_stages(axes, loops)
        light_grid(axes)
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=4, loc="outside upper center")
    return figure


def draw_courses(axes: Axes, loops: pd.DataFrame, looks: Looks, column: str) -> None:
    """Draw the `course` of every condition, with its interval as a band."""
    for condition, look in looks.items():
        curve = course(loops, condition, column)
        band = curve.index, curve["low"], curve["high"]
        axes.fill_between(*band, color=look.colour, alpha=0.16, linewidth=0)
        axes.plot(curve.index, curve["value"], **look.curve(), markevery=EVERY, label=condition)


def mark_stages(axes: Axes, loops: pd.DataFrame, *, named: bool = False) -> None:
    """Mark where stages begin, in loops as `along_stages` gives them."""
    last = loops["loop"].max()
    axes.set_xlim(0.5, last + 0.5)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    begins = loops.groupby("phase")["loop"].min()
    if len(begins) < 2:
        return
    edges = [*begins, last + 1]
    for stage, begin, end in zip(begins.index, edges, edges[1:], strict=False):
        if begin > 1:
            axes.axvline(begin - 0.5, color=FAINT, linewidth=1.0)
        if named:
            axes.annotate(
                f"stage {stage}", ((begin + end - 1) / 2, 1.0), color=FAINT,
                xycoords=("data", "axes fraction"), ha="center", va="bottom",
            )  # fmt: skip


def plain_log(axes: Axes) -> None:
    """Label a logarithmic axis with plain numbers at 1, 2, 5."""
    axes.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    light_grid(axes)
