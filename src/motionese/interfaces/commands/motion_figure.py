"""Motions drawn: one small panel a channel, time along, every motion a line."""

import warnings
from collections.abc import Callable, Sequence
from math import ceil
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int
from matplotlib import rc_context
from matplotlib.figure import Figure
from numpy import ndarray

from motionese.errors import StorageError
from motionese.figure_style import FAINT, HUES, INK, SETTINGS, WIDTH, as_png, as_svg
from motionese.files import write_whole

COLUMNS, PANEL_HEIGHT, MOST = 3, 1.5, 30
"""Panels side by side, their height [inch], and how many channels are drawn at most."""
LEFT, RIGHT, TOP, BOTTOM = 0.75, 0.15, 0.65, 0.55
"""Around the panels [inch]: numbers, nothing, the titles, and the axis of time."""
LEGEND, LEGEND_COLUMNS = 0.25, 4
"""Height of a line of names [inch], and how many stand in one."""
POINTS = 240
"""Pieces that an episode's rows are drawn in at most, each by its lowest and highest value."""
LARGEST = 1e100
"""Beyond it values are gaps: an axis' arithmetic overflows."""
MANY = 8
"""From so many motions on, lines are thin and pale and have no names."""
COLOURS = [*(colour for hue in HUES for colour in hue), "#cc79a7", "#000000"]
"""Okabe & Ito's palette: distinguishable without colour vision."""


def write_figure(
    path: Path,
    paths: Sequence[Float[ndarray, "_ D"]],
    names: Sequence[str],
    channels: Sequence[tuple[str, str]],
    rate_hz: float | None,
    title: str,
) -> None:
    """Draw motions and write the figure as SVG or PNG.

    Args:
        path: The file to write; PNG if it ends so, else SVG.
        paths: The motions; NaN where nothing was observed. [T_i, D]
        channels: Name and unit of every channel.
        rate_hz: Rows per second [Hz]; rows are counted where it is None.

    Raises:
        StorageError: A file that cannot be written.
    """
    if len(channels) > MOST:
        title += f" (the first {MOST} of {len(channels)} channels)"
    write_drawing(path, "motions", lambda: _figure(paths, names, channels[:MOST], rate_hz, title))


def write_drawing(path: Path, name: str, draw: Callable[[], Figure]) -> None:
    """Draw a figure in the package's style and write it as SVG, or as PNG if `path` ends so.

    Args:
        path: The file to write.
        name: What the names within the SVG begin with.
        draw: Draws it.

    Raises:
        StorageError: A file that cannot be written.
    """
    # Names are what they are, dollars included.
    with rc_context({**SETTINGS, "text.parse_math": False}), warnings.catch_warnings():
        # A viewer of SVG has fonts for all scripts; a PNG shows a box where ours has no letter.
        warnings.filterwarnings("ignore", "Glyph .* missing", UserWarning)
        drawn = draw()
        content = as_png(drawn) if path.suffix.lower() == ".png" else as_svg(drawn, name)
    try:
        write_whole(path, content)
    except OSError as error:
        raise StorageError(f"{path}: cannot be written: {error.strerror}") from error


def _figure(
    paths: Sequence[Float[ndarray, "_ D"]],
    names: Sequence[str],
    channels: Sequence[tuple[str, str]],
    rate_hz: float | None,
    title: str,
) -> Figure:
    columns = min(COLUMNS, len(channels))
    rows = ceil(len(channels) / columns)
    few = len(paths) < MANY
    legend = LEGEND * ceil(len(paths) / LEGEND_COLUMNS) if few and len(paths) > 1 else 0.0
    height = rows * PANEL_HEIGHT + TOP + BOTTOM + legend
    # Panels that all hold the same need no layout that measures every text, which is most of the
    # time that a figure takes. matplotlib's types leave "none" out.
    figure = Figure(figsize=(WIDTH, height), layout="none")  # type: ignore[arg-type]
    panels = figure.subplots(
        rows,
        columns,
        sharex=True,
        squeeze=False,
        gridspec_kw={
            "left": LEFT / WIDTH,
            "right": 1 - RIGHT / WIDTH,
            "top": 1 - TOP / height,
            "bottom": (BOTTOM + legend) / height,
            "wspace": 0.25,
            "hspace": 0.45,
        },
    ).ravel()
    for column, (panel, (name, unit)) in enumerate(zip(panels, channels, strict=False)):
        for i, motion in enumerate(paths):
            shown, values = thinned(np.ascontiguousarray(motion[:, column]))
            panel.plot(
                shown / (rate_hz or 1.0),
                np.where(np.abs(values) <= LARGEST, values, np.nan),
                color=COLOURS[i % len(COLOURS)] if few else INK,
                linewidth=1.4 if few else 0.7,
                alpha=1.0 if few else 0.35,
                label=names[i] if few else None,
            )
        # Told where it stands, it is not moved out of the way of ticks that are measured for that.
        panel.set_title(f"{name} [{unit}]" if unit else name, y=1.0)
        panel.grid(visible=True, color=FAINT, alpha=0.2)
    for panel in panels[len(channels) :]:
        panel.set_visible(False)
    for panel in panels[max(len(channels) - columns, 0) : len(channels)]:
        panel.set_xlabel("time [s]" if rate_hz else "row")
        panel.tick_params(labelbottom=True)
    if few and len(paths) > 1:
        handles, labels = panels[0].get_legend_handles_labels()
        figure.legend(handles, labels, loc="lower left", ncols=LEGEND_COLUMNS)
    figure.suptitle(title, x=0.01, y=1 - 0.1 / height, ha="left", va="top")
    return figure


def thinned(values: Float[ndarray, " T"]) -> tuple[Int[ndarray, " K"], Float[ndarray, " K"]]:
    """Return rows and values that look as all of them do: the extremes of every few rows.

    Of rows of which any is NaN, the first that is stands for a break in the line.
    """
    step = len(values) // POINTS
    if step < 2:
        return np.arange(len(values)), values
    whole = len(values) // step * step
    blocks = values[:whole].reshape(-1, step)
    lowest_is_nan = np.where(np.isnan(blocks), -np.inf, blocks)
    ends = [lowest_is_nan.argmin(axis=1), lowest_is_nan.argmax(axis=1)]
    rows = np.sort(np.stack(ends, axis=1), axis=1) + np.arange(0, whole, step)[:, None]
    rows = np.append(rows.ravel(), np.arange(whole, len(values)))
    return rows, values[rows]
