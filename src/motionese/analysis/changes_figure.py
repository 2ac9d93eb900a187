"""How many runs had changed, and had mastered the last lesson, after each loop."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from motionese.analysis.changes import NEEDED
from motionese.analysis.curves import Looks
from motionese.analysis.style import light_grid
from motionese.figure_style import WIDTH


def changes_figure(table: pd.DataFrame, looks: Looks) -> Figure:
    """Draw the share of runs that had got somewhere after each loop, a panel a change.

    Args:
        table: As of `changes`.
        looks: How each condition is drawn.
    """
    titles = {
        **{c: f"Stage {c.split('_')[1]} ended" for c in map(str, table) if c.startswith("stage_")},
        **{
            c: f"{c.split('_')[0].capitalize()} opened"
            for c in map(str, table)
            if c.endswith("_opens")
        },
        NEEDED: "Last lesson mastered",
    }
    present = {name: look for name, look in looks.items() if name in set(table["condition"])}
    last = int(table["loops"].max())
    figure = Figure(figsize=(WIDTH, 3.0))
    panels = figure.subplots(1, len(titles), sharex=True, sharey=True, squeeze=False)[0]
    for axes, (column, title) in zip(panels, titles.items(), strict=True):
        for name, look in present.items():
            values = table.loc[table["condition"] == name, column].to_numpy(dtype=float)
            loops = np.arange(last + 1)
            share = 100 * (values[:, None] <= loops).mean(axis=0)
            paint = {**look.curve(), "marker": ""}
            axes.step(loops, share, where="post", **paint, label=name)
        axes.set(title=title, xlabel="imitation loop", xlim=(0, last + 0.5), ylim=(-3, 103))
        light_grid(axes)
    panels[0].set_ylabel("runs [%]")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=4, loc="outside upper center")
    return figure
