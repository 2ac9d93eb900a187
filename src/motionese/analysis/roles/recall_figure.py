"""Recall over the loops, the strokes that must be remembered apart from the others."""

import pandas as pd
from matplotlib.figure import Figure

from motionese.analysis.curves import Looks, draw_courses, mark_stages, plain_log
from motionese.figure_style import WIDTH

STROKES = {True: "Ambiguous strokes", False: "All other strokes"}


def recall(strokes: pd.DataFrame, looks: Looks) -> Figure:
    """Draw the recall error of strokes over the loops, a curve a condition.

    Args:
        strokes: As of `strokes_recalled`, of loops as `along_stages` gives them.
        looks: How each condition is drawn.
    """
    kinds = [kind for kind in STROKES if (strokes["ambiguous"] == kind).any()]
    figure = Figure(figsize=(WIDTH, 3.6))
    panels = figure.subplots(1, len(kinds), sharex=True, sharey=True, squeeze=False)[0]
    for axes, kind in zip(panels, kinds, strict=True):
        own = strokes[strokes["ambiguous"] == kind]
        present = {name: look for name, look in looks.items() if name in set(own["condition"])}
        axes.set_yscale("log")
        draw_courses(axes, own, present, "recall_cm")
        mark_stages(axes, strokes, named=True)
        plain_log(axes)
        axes.set_xlabel("imitation loop")
        axes.set_title(STROKES[kind], pad=18)
    panels[0].set_ylabel("recall error [cm], log scale")
    handles, labels = panels[-1].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=len(handles), loc="outside upper center")
    return figure
