"""Belief drawn: which motion was believed to be shown against time, and the window's error."""

from collections.abc import Sequence
from math import ceil
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from motionese.figure_style import FAINT, INK, WIDTH
from motionese.interfaces.commands.motion_figure import COLOURS, write_drawing
from motionese.interfaces.commands.online_trace import OnlineTrace

COLUMNS, PAIR_HEIGHT, MOST = 2, 3.0, 12
"""Motions side by side, the height of one [inch], and how many are drawn at most."""
NAMED = len(COLOURS)
"""Learned motions that have a colour and a name: those that were believed in most."""


def write_belief_figure(path: Path, traces: Sequence[OnlineTrace], title: str) -> None:
    """Draw what was believed of motions while they were shown, and write the figure.

    Args:
        path: The file to write; PNG if it ends so, else SVG.
        traces: What was known, by the same hypotheses.
        title: The figure's.

    Raises:
        StorageError: A file that cannot be written.
    """
    if len(traces) > MOST:
        title += f" (the first {MOST} of {len(traces)} motions)"
    write_drawing(path, "belief", lambda: _figure(traces[:MOST], title))


def _figure(traces: Sequence[OnlineTrace], title: str) -> Figure:
    columns = min(COLUMNS, len(traces))
    pairs = ceil(len(traces) / columns)
    figure = Figure(figsize=(WIDTH, pairs * PAIR_HEIGHT + 1.1))
    ratios = [5, 3] * pairs
    grid = figure.subplots(2 * pairs, columns, squeeze=False, sharex=True, height_ratios=ratios)
    most = np.concatenate([one.belief for one in traces]).max(axis=0)[:-1]
    named = sorted(np.argsort(-most, kind="stable")[:NAMED].tolist())
    largest = 100 * max(np.nanmax(one.error, initial=0.0) for one in traces)
    for i in range(pairs * columns):
        upper, lower = grid[2 * (i // columns) : 2 * (i // columns) + 2, i % columns]
        if i < len(traces):
            _draw_belief(upper, traces[i], named)
            _draw_error(lower, traces[i], largest)
            if i + columns >= len(traces):
                lower.set_xlabel("time [s]")
                lower.tick_params(labelbottom=True)
        else:
            upper.set_visible(False)
            lower.set_visible(False)
    grid[0, 0].set_xlim(0, max((len(one.error) - 1) / one.rate_hz for one in traces))
    figure.legend(*grid[0, 0].get_legend_handles_labels(), loc="outside lower left", ncols=4)
    figure.suptitle(title, x=0.01, ha="left")
    return figure


def _draw_belief(panel: Axes, one: OnlineTrace, named: Sequence[int]) -> None:
    """Stack the belief in each named motion, in all others, and in none of them."""
    rest = one.belief.shape[1] - 1 - len(named)
    shares = [one.belief[:, i] for i in named]
    colours, labels = list(COLOURS[: len(named)]), [one.hypotheses[i] for i in named]
    if rest:
        shares.append(one.belief[:, :-1].sum(axis=1) - sum(shares))
        colours.append(f"{FAINT}55")
        labels.append(f"{rest} other{'s' * (rest > 1)}")
    shares.append(one.belief[:, -1])
    time = np.arange(len(one.belief)) / one.rate_hz
    panel.stackplot(time, shares, colors=[*colours, FAINT], labels=[*labels, one.hypotheses[-1]])
    panel.set_title(one.name)
    panel.set_ylim(0, 1)
    panel.set_ylabel("belief [share]")


def _draw_error(panel: Axes, one: OnlineTrace, largest: float) -> None:
    panel.plot(np.arange(len(one.error)) / one.rate_hz, 100 * one.error, color=INK, linewidth=1.2)
    panel.set_ylim(0, 1.05 * largest or 1.0)
    panel.set_ylabel("error\n[% of range]")
    panel.grid(visible=True, color=FAINT, alpha=0.2)
