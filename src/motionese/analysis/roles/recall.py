"""Recall stroke by stroke: how far what the network recalls is from what the body did [cm]."""

import numpy as np
import pandas as pd

from motionese.analysis.roles.branching import branches
from motionese.task import Task


def strokes_recalled(loops: pd.DataFrame, task: Task) -> pd.DataFrame:
    """Return a row per loop, motion and stroke.

    The columns are `condition`, `seed`, `loop`, `phase`, `motion`, `stroke` (from 1), `recall_cm`,
    and `ambiguous`: another motion of the lesson goes on otherwise after the same beginning.
    """
    kept = loops[["condition", "seed", "loop", "phase", "motion"]].reset_index(drop=True)
    told = loops["reproduction_strokes_cm"].astype(str).reset_index(drop=True)
    kept = kept.assign(recall_cm=told.str.split()).explode("recall_cm")
    kept["recall_cm"] = kept["recall_cm"].astype(float)
    kept["stroke"] = kept.groupby(level=0).cumcount() + 1
    kept = kept.reset_index(drop=True)
    ambiguous = np.zeros(len(kept), dtype=bool)
    for _, own in kept.groupby(["condition", "phase"]):
        found = branches([task.sequence(name) for name in own["motion"].unique()])
        pairs = zip(own["motion"], own["stroke"], strict=True)
        ambiguous[own.index] = [pair in found for pair in pairs]
    return kept.assign(ambiguous=ambiguous)
