"""How much of the map of Cs_0 leads which way on, where motions go on in different ways."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

from motionese.analysis.directions import share_within
from motionese.analysis.roles.role_shares import WHO

Ways = Mapping[str, tuple[str, ...]]
"""By a primitive after which motions go on in different ways, those ways; as of `ways_on`."""


def order_on_map(
    points: pd.DataFrame, ways: Mapping[str, Ways], strokes: Mapping[str, tuple[float, float]]
) -> "pd.Series[float]":
    """Return, for every run, the smallest share of the map that leads one of the ways on.

    It is 0 where Cs_0 decides nothing, and at most one divided by the number of ways; the mean is
    taken over the primitives after which there are several.

    Args:
        points: Maps of runs, a row per primitive and point.
        ways: By condition.
        strokes: Every primitive's direction [rad] and extent [rad] as the robot sees it.
    """
    smallest = {
        (condition, seed): np.mean([_smallest(own, first, on, strokes) for first, on in of.items()])
        for (condition, seed), own in points.groupby(WHO, sort=False)
        if (of := ways[str(condition)])
    }
    return pd.Series(smallest, index=pd.MultiIndex.from_tuples(smallest, names=WHO), dtype=float)


def _smallest(
    own: pd.DataFrame,
    first: str,
    on: tuple[str, ...],
    strokes: Mapping[str, tuple[float, float]],
) -> float:
    second = own.loc[own["primitive"] == first, "direction_2_rad"].to_numpy(dtype=np.float64)
    return min(share_within(second, [strokes[way][0]]) for way in on)
