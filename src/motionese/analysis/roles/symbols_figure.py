"""Primitives as symbols: what is read out of the network while it performs."""

from collections.abc import Mapping

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from motionese.analysis.curves import Looks
from motionese.analysis.roles.seed_points import draw_columns, legend
from motionese.analysis.style import ASTRAY
from motionese.figure_style import INK, WIDTH

COLUMNS = {
    "symbols_right": "sequence\nread right",
    "boundaries_right": "boundaries within\ntwo steps",
}


def symbols(
    table: pd.DataFrame,
    looks: Looks,
    examples: Mapping[str, pd.DataFrame],
    yours: pd.DataFrame | None = None,
) -> Figure:
    """Draw the shares of what is read right, and beside them what single runs read.

    Args:
        table: A row per condition and seed.
        looks: How each condition is drawn.
        examples: By condition, rows of one run: `motion`, `read` and `true` signs; or none.
        yours: The same as `table` of other runs.
    """
    figure = Figure(figsize=(WIDTH if examples else 0.6 * WIDTH, 3.5))
    shares, *texts = figure.subplots(1, 2 if examples else 1, squeeze=False)[0]
    draw_columns(shares, table, looks, COLUMNS, yours)
    shares.set(ylabel="share", ylim=(-0.04, 1.06))
    for axes in texts:
        _write(axes, looks, examples)
    legend(figure, looks, yours)
    return figure


def _write(axes: Axes, looks: Looks, examples: Mapping[str, pd.DataFrame]) -> None:
    """Write a column of true sequences, and one of what was read per condition."""
    shown = {name: rows.set_index("motion") for name, rows in examples.items() if name in looks}
    motions = list(dict.fromkeys(m for rows in shown.values() for m in rows.index))
    for row, motion in enumerate(motions):
        axes.annotate(motion, (0, row), va="center", fontsize=11)
    for column, (name, rows) in enumerate(shown.items(), start=1):
        axes.annotate(name, (column, -1), va="center", color=looks[name].colour, fontweight="bold")
        for row, motion in enumerate(motions):
            if motion in rows.index:
                read, true = (rows.loc[motion, which] for which in ("read", "true"))
                said = read if isinstance(read, str) else "nothing"
                colour = INK if read == true else ASTRAY
                axes.annotate(said, (column, row), va="center", fontsize=11, color=colour)
    axes.annotate("shown", (0, -1), va="center")
    axes.set(xlim=(-0.2, 5), ylim=(max(len(motions), 5), -1.6))
    axes.axis("off")
