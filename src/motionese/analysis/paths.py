"""Where the hand went, against what was shown: every new sequence of one run a condition."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Float
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy import ndarray

from motionese.analysis.experiment_data import ExperimentData
from motionese.figure_style import FAINT, INK, WIDTH
from motionese.task import Task

CAP_RADIUS_CM = 3.5
"""Radius of a button's cap [cm]."""


def paths(kept: Mapping[str, Mapping[str, ndarray]], data: ExperimentData) -> Figure:
    """Draw shown and performed paths of a run per condition, as the robot sees them."""
    task = data.task
    motions = [s.name for name in task.novel for s in task.lesson(name)]
    figure = Figure(figsize=(WIDTH, 0.7 + 1.22 * len(kept)))
    panels = figure.subplots(len(kept), len(motions), sharex=True, sharey=True, squeeze=False)
    for row, (condition, arrays) in zip(panels, kept.items(), strict=True):
        for axes, motion in zip(row, motions, strict=True):
            _places(axes, task)
            if f"shown.{motion}" in arrays:
                shown = _in_front(arrays[f"shown.{motion}"])
                axes.plot(*shown, color=FAINT, linewidth=3.2, alpha=0.55, solid_capstyle="round")
                right, up = _in_front(arrays[f"performed.{motion}"])
                axes.plot(right, up, color=data.looks[condition].colour, linewidth=1.4)
                axes.plot(right[0], up[0], marker="o", color=INK, markersize=3.5)
            axes.set_aspect("equal")
            axes.tick_params(labelsize=7.5, length=2)
        row[0].set_ylabel(f"{condition}\nheight [cm]")
    for axes, motion in zip(panels[0], motions, strict=True):
        axes.set_title(motion, loc="center")
    figure.supxlabel("to the robot's right [cm]", fontsize=9.5)
    return figure


def _places(axes: Axes, task: Task) -> None:
    """Mark the places where something is to be brought about by a bar, as wide as a cap."""
    for place in dict.fromkeys(p.end for p in task.primitives if p.effect):
        right, up = _in_front(task.position(place)[None])
        ends = [right[0] - CAP_RADIUS_CM, right[0] + CAP_RADIUS_CM]
        axes.plot(ends, [up[0], up[0]], color=INK, linewidth=1.2)


def _in_front(path: Float[ndarray, "T 3"]) -> Float[ndarray, "2 T"]:
    """Return a path [m, world] as the robot sees it: to its right and up [cm]."""
    return 100 * np.stack([-path[:, 1], path[:, 2]])
