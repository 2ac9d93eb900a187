"""The map of the slow initial states (Fig. 10): which way the hand goes from every point of it."""

from collections.abc import Mapping

import numpy as np
from jaxtyping import Complex, Float
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from numpy import ndarray

from motionese.analysis.directions import following
from motionese.analysis.experiment_data import ExperimentData
from motionese.analysis.map_numbers import level_names
from motionese.analysis.style import ASTRAY
from motionese.figure_style import FAINT, WIDTH
from motionese.imitation.strokes import WITHIN

HEAD = np.radians(150)
"""The barbs of an arrow point back by this angle."""


def slow_state_map(data: ExperimentData, shown: Mapping[str, int], segment: int) -> Figure:
    """Draw the map of one seed a condition: a row per condition, a column per primitive.

    An arrow is as long as a grid cell where the hand goes as far as the stroke is long. `shown` are
    the conditions' seeds; segment 1 is the primitive whose state is held, 2 what follows it.
    """
    points, strokes = data.slow_state_map, data.strokes
    below, top = (name.capitalize() for name in level_names(data.study))
    figure = Figure(figsize=(WIDTH, 0.6 + 1.76 * len(shown)))
    panels = figure.subplots(len(shown), len(strokes), sharex=True, sharey=True, squeeze=False)
    for row, (condition, seed) in zip(panels, shown.items(), strict=True):
        own = points[(points["condition"] == condition) & (points["seed"] == seed)]
        for axes, name in zip(row, strokes, strict=True):
            right = (name,) if segment == 1 else following(data.task, name)
            of = own[own["primitive"] == name]
            grid = of[[f"{top.lower()}_1", f"{top.lower()}_2"]].to_numpy(dtype=np.float64)
            ways = of[[f"direction_{segment}_rad", f"extent_{segment}_rad"]].to_numpy(np.float64)
            colour = data.looks[condition].colour
            _panel(axes, grid, ways, [strokes[r] for r in right], colour)
        row[0].set_ylabel(f"{condition}\n{top}₀, second unit")
    for axes, name in zip(panels[0], strokes, strict=True):
        axes.set_title(f"{below}₀ of {name}", loc="center")
    for axes in panels[-1]:
        axes.set_xlabel(f"{top}₀, first unit")
    return figure


def _panel(
    axes: Axes,
    grid: Float[ndarray, "G 2"],
    ways: Float[ndarray, "G 2"],
    right: list[tuple[float, float]],
    colour: str,
) -> None:
    directions, extents = ways.T
    off = np.abs(np.angle(np.exp(1j * (directions[:, None] - [angle for angle, _ in right]))))
    near = off.min(axis=1) <= WITHIN
    sides = np.unique(grid[:, 0])
    cell = float(sides[1] - sides[0])
    lengths = cell * np.minimum(extents / np.mean([extent for _, extent in right]), 1.0)
    arrows = lengths * np.exp(1j * directions)
    for chosen, paint in ((near, colour), (~near, ASTRAY)):
        if chosen.any():
            axes.add_patch(_arrows(grid[chosen], arrows[chosen], paint))
    limits = (sides[0] - cell, sides[-1] + cell)
    ticks = [sides[0], 0, sides[-1]]
    axes.set(xlim=limits, ylim=limits, aspect="equal", xticks=ticks, yticks=ticks)
    axes.spines[["top", "right"]].set_visible(True)
    axes.spines[:].set_color(FAINT)


def _arrows(grid: Float[ndarray, "G 2"], z: Complex[ndarray, " G"], colour: str) -> PathPatch:
    """Return arrows z = x + iy centred on grid points, as one path."""
    middle = grid @ np.array([1, 1j])
    tail, tip = middle - z / 2, middle + z / 2
    barbs = [tip + 0.38 * z * np.exp(1j * turn) for turn in (HEAD, -HEAD)]
    lines = np.stack([tail, tip, barbs[0], tip, barbs[1]], axis=1).reshape(-1)
    codes = np.tile([Path.MOVETO] + [Path.LINETO] * 4, len(z))
    path = Path(np.stack([lines.real, lines.imag], axis=1), codes)
    return PathPatch(path, fill=False, edgecolor=colour, linewidth=0.8, joinstyle="round")
