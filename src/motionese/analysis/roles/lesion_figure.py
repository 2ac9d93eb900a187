"""Lesions: what is left of first strokes and of branches when a level is silenced."""

import pandas as pd
from matplotlib.figure import Figure

from motionese.analysis.curves import Looks
from motionese.analysis.roles.seed_points import draw_columns, legend
from motionese.figure_style import FAINT, WIDTH

STROKES = {"first": "First strokes", "branch": "Branches: ambiguous strokes"}
LESIONS = {
    "intact": "intact",
    "without_cf": "Cf₀ set\nto its mean",
    "without_cs": "Cs₀ set\nto its mean",
    "cut": "Cs → Cf\ncut",
}


def lesions(
    table: pd.DataFrame, looks: Looks, chance: float, yours: pd.DataFrame | None = None
) -> Figure:
    """Draw the shares of right strokes by lesion and condition.

    Args:
        table: A row per condition and seed.
        looks: How each condition is drawn.
        chance: The share of right branches by chance.
        yours: The same as `table` of other runs.
    """
    present = [kind for kind in STROKES if table[f"{kind}_intact"].notna().any()]
    figure = Figure(figsize=(WIDTH if len(present) > 1 else WIDTH * 0.6, 3.5))
    panels = figure.subplots(1, max(len(present), 1), sharey=True, squeeze=False)[0]
    for axes, kind in zip(panels, present, strict=False):
        columns = {f"{kind}_{lesion}": said for lesion, said in LESIONS.items()}
        draw_columns(axes, table, looks, columns, yours)
        axes.set(title=STROKES[kind], ylim=(-0.04, 1.06))
        if kind == "branch":
            axes.axhline(chance, color=FAINT, linewidth=0.9, linestyle=":")
            axes.annotate(
                "chance", (0, chance), xycoords=("axes fraction", "data"), xytext=(3, 2),
                textcoords="offset points", ha="left", color=FAINT, fontsize=8,
            )  # fmt: skip
    panels[0].set_ylabel("share of right strokes")
    legend(figure, looks, yours)
    return figure
