"""Two maps of Cs_0 for one Cf_0: which way the first stroke goes, and which way on."""

from collections.abc import Mapping

import numpy as np
import pandas as pd
from jaxtyping import Float
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from numpy import ndarray

from motionese.figure_style import FAINT, PAPER, WIDTH
from motionese.imitation.strokes import WITHIN

DIRECTIONS = colormaps["twilight_shifted"]
"""A colour for every direction, the same in print for those that are told apart without colour."""
LIGHT = "#f4f4f4"
ARROWS = {"→": 0.0, "↑": np.pi / 2, "←": np.pi, "↓": -np.pi / 2}


def order_map(
    maps: Mapping[str, pd.DataFrame],
    primitive: str,
    ways: Mapping[str, float],
    levels: tuple[str, str],
) -> Figure:
    """Draw, a column per condition, the map of one run for one primitive's Cf_0.

    Above, every point has the colour of the direction in which the first stroke goes from it; below
    it has that of the way on which the second stroke takes, if it takes one.

    Args:
        maps: By condition, a row per point: its place on the map, directions [rad] of strokes.
        primitive: Whose Cf_0 is held.
        ways: Directions [rad] of the strokes that may follow, by name.
        levels: The names of the level whose initial state is held, and of the one that varies.
    """
    held, varied = (name.capitalize() for name in levels)
    figure = Figure(figsize=(WIDTH, 4.6))
    columns = len(maps)
    panels = figure.subplots(2, columns + 1, squeeze=False, width_ratios=[1.0] * columns + [0.62])
    figure.suptitle(f"{held}₀ of {primitive} held, {varied}₀ varied", fontsize=10)
    for column, (condition, points) in enumerate(maps.items()):
        grids = [_grid(points, levels[1], segment) for segment in (1, 2)]
        side = np.unique(points[f"{levels[1]}_1"])
        _paint(panels[0, column], DIRECTIONS(_turns(grids[0])), side)
        _regions(panels[1, column], grids[1], ways, side)
        panels[0, column].set_title(condition, loc="center")
        panels[1, column].set_xlabel(f"{varied}₀, first unit")
    for row, stroke in zip(panels, ("first stroke", "second stroke"), strict=True):
        row[0].set_ylabel(f"{stroke}\n{varied}₀, second unit")
        for axes in row[1:columns]:
            axes.tick_params(labelleft=False)
        row[-1].axis("off")
    for axes in panels[0, :columns]:
        axes.tick_params(labelbottom=False)
    _wheel(panels[0, -1])
    _key(panels[1, -1], ways)
    return figure


def _grid(points: pd.DataFrame, level: str, segment: int) -> Float[ndarray, "K K"]:
    """Return directions [rad] as an image: the first unit to the right, the second upwards."""
    table = points.pivot_table(
        f"direction_{segment}_rad", index=f"{level}_2", columns=f"{level}_1", aggfunc="first"
    )
    return table.sort_index().to_numpy(dtype=np.float64)


def _turns(directions: float | Float[ndarray, "*shape"]) -> Float[ndarray, "*shape"]:
    """Return directions [rad] as shares of a turn, 0 for one to the left."""
    return np.asarray(np.mod(directions + np.pi, 2 * np.pi) / (2 * np.pi))


def _paint(axes: Axes, image: Float[ndarray, "K K 4"], side: Float[ndarray, " K"]) -> None:
    half = (side[1] - side[0]) / 2
    edges = (side[0] - half, side[-1] + half)
    axes.imshow(image, origin="lower", extent=(*edges, *edges), interpolation="none")
    axes.set(xticks=[side[0], 0, side[-1]], yticks=[side[0], 0, side[-1]])
    axes.spines[["top", "right"]].set_visible(True)


def _regions(
    axes: Axes,
    directions: Float[ndarray, "K K"],
    ways: Mapping[str, float],
    side: Float[ndarray, " K"],
) -> None:
    image = np.zeros((*directions.shape, 4))
    for name, angle in ways.items():
        near = np.abs(np.angle(np.exp(1j * (directions - angle)))) <= WITHIN
        image[near] = DIRECTIONS(_turns(angle))
        if near.any():
            cells = side[np.argwhere(near)[:, ::-1]]
            middle = cells[np.linalg.norm(cells - cells.mean(axis=0), axis=1).argmin()]
            axes.annotate(name[-1], middle, color=LIGHT, ha="center", va="center", fontsize=13)
    _paint(axes, image, side)


def _wheel(axes: Axes) -> None:
    """Draw which colour a direction has."""
    x, y = np.meshgrid(np.linspace(-1, 1, 121), np.linspace(-1, 1, 121))
    image = DIRECTIONS(_turns(np.arctan2(y, x)))
    radius = np.hypot(x, y)
    image[(radius > 1) | (radius < 0.55), 3] = 0
    axes.imshow(image, origin="lower", extent=(-1, 1, -1, 1), interpolation="none")
    for arrow, angle in ARROWS.items():
        axes.annotate(arrow, (0.33 * np.cos(angle), 0.33 * np.sin(angle)), ha="center", va="center")
    axes.set(xlim=(-1.5, 1.5), ylim=(-1.5, 1.5), title="direction")


def _key(axes: Axes, ways: Mapping[str, float]) -> None:
    named = {f"on by {name}": DIRECTIONS(_turns(angle)) for name, angle in ways.items()}
    handles = [Patch(color=colour, label=name) for name, colour in named.items()]
    handles.append(Patch(facecolor=PAPER, edgecolor=FAINT, label="elsewhere"))
    axes.legend(handles=handles, loc="center", fontsize=8.5, handlelength=1.2, borderpad=0)
