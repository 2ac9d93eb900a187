"""What happened inside: activity of all units during one performance, and its principal plane."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from matplotlib.axes import Axes
from matplotlib.figure import Figure, SubFigure
from numpy import ndarray

from motionese.analysis.curves import Looks
from motionese.figure_style import FAINT, INK, PAPER, WIDTH

FEW_UNITS = 15
"""A level of more units is drawn in rows of a quarter of the height."""


@dataclass(frozen=True)
class Performed:
    """One performance from within: y of all units [T, N], and the columns of each level.

    Levels go from IO upwards; `boundaries` are the rows at which a next primitive begins.
    """

    activity: Float[ndarray, "T N"]
    levels: Mapping[str, slice]
    boundaries: Sequence[int]
    rate_hz: float


def principal_plane(
    activity: Float[ndarray, "T n"],
) -> tuple[Float[ndarray, "T 2"], Float[ndarray, "2"]]:
    """Return the activity in the plane of its largest variance, and each axis's share of it."""
    centred = np.pad(activity - activity.mean(axis=0), ((0, 0), (0, max(0, 2 - activity.shape[1]))))
    u, s, vt = np.linalg.svd(centred.astype(np.float64), full_matrices=False)
    # The sign of an axis is arbitrary; its largest loading is taken as positive.
    signs = np.sign(vt[np.arange(2), np.abs(vt[:2]).argmax(axis=1)])
    total = (s**2).sum()
    share = s[:2] ** 2 / total if total else np.zeros(2)
    return u[:, :2] * s[:2] * signs, share


def inside(performed: Mapping[str, Performed], motion: str, looks: Looks) -> Figure:
    """Draw, a row per condition, the activity over time and the context's principal planes."""
    figure = Figure(figsize=(WIDTH, 0.4 + 2.35 * len(performed)))
    rows = figure.subfigures(len(performed), 1, squeeze=False)[:, 0]
    for place, (row, (condition, one)) in enumerate(zip(rows, performed.items(), strict=True)):
        context = [name for name in one.levels if name != "io"]
        widths = [2.0, *[1.0] * len(context)]
        left, *planes = row.subfigures(1, len(widths), width_ratios=widths)
        _activity(left, one, f"{condition}, {motion}", last=place == len(rows) - 1)
        for part, name in zip(planes, context, strict=True):
            _plane(part.subplots(), one, name, looks[condition].colour)
    return figure


def _activity(figure: SubFigure, one: Performed, title: str, *, last: bool) -> None:
    sizes = [part.stop - part.start for part in one.levels.values()]
    heights = [size * (2.0 if size <= FEW_UNITS else 0.5) for size in sizes]
    # The slowest level is on top, as in drawings of the network.
    heights.reverse()
    panels = figure.subplots(len(heights), sharex=True, squeeze=False, height_ratios=heights)[:, 0]
    duration = len(one.activity) / one.rate_hz
    for axes, (name, part) in zip(panels, reversed(list(one.levels.items())), strict=True):
        picture = axes.imshow(
            one.activity[:, part].T, aspect="auto", interpolation="none", cmap="cividis",
            vmin=0, vmax=1, extent=(0, duration, 0, 1),
        )  # fmt: skip
        for row in one.boundaries:
            axes.axvline(row / one.rate_hz, color=PAPER, linewidth=1.2)
        axes.set_yticks([])
        label = name.capitalize() if name != "io" else "IO"
        axes.set_ylabel(label, rotation=0, ha="right", va="center")
        axes.spines[:].set_visible(False)
    panels[0].set_title(title)
    for axes in panels:
        axes.tick_params(length=2, labelbottom=axes is panels[-1] and last)
    panels[-1].set_xlabel("time [s]" if last else "")
    bar = figure.colorbar(picture, ax=list(panels), pad=0.02, aspect=28, ticks=[0, 0.5, 1])
    bar.outline.set_visible(False)
    bar.set_label("activity y")
    bar.ax.tick_params(labelsize=7.5, length=2)


def _plane(axes: Axes, one: Performed, level: str, colour: str) -> None:
    points, share = principal_plane(one.activity[:, one.levels[level]])
    axes.plot(*points.T, color=colour, linewidth=1.5)
    axes.plot(*points.T, color=colour, marker=".", markersize=3, linestyle="none")
    axes.plot(*points[0], marker="o", color=INK, markersize=6, linestyle="none")
    for number, row in enumerate(one.boundaries, start=2):
        axes.plot(*points[row], marker="o", color=PAPER, markeredgecolor=INK, markersize=10,
                  linestyle="none")  # fmt: skip
        axes.annotate(str(number), points[row], ha="center", va="center_baseline", fontsize=7.5)
    axes.plot(*points[-1], marker="s", color=INK, markersize=5.5, linestyle="none")
    axes.set_title(f"{level.capitalize()}, principal plane", fontsize=9)
    axes.set(xlabel=f"PC 1 ({share[0]:.0%})", ylabel=f"PC 2 ({share[1]:.0%})")
    axes.margins(0.14)
    axes.set_aspect("equal", adjustable="datalim")
    axes.tick_params(labelsize=7.5, length=2)
    axes.spines[["top", "right"]].set_visible(True)
    axes.spines[:].set_color(FAINT)
    axes.locator_params(nbins=4)
