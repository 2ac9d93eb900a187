"""Shares of what was found in the tables of roles, one a run: who is followed, what is lost.

In names of columns `cf` is the level below the top one and `cs` the top one, whatever they are
called. A run that has no case of something has no value.
"""

import numpy as np
import pandas as pd

WHO = ["condition", "seed"]
"""What tells one run from another; results are indexed by it."""
WITHIN_STEPS = 2
"""A boundary that is read so many steps off, or fewer, is right."""

ByRun = dict[str, "pd.Series[float]"]


def followed(exchanges: pd.DataFrame, below: str) -> ByRun:
    """Return whose initial states are followed where the levels above `below` are another's.

    `first_by_cf` and `first_by_cs` are shares of the first strokes, `order_by_cf` and `order_by_cs`
    of the later strokes that are the first to differ; the rest follows neither. `separation` is the
    smaller one of `first_by_cf` and `order_by_cs`. States recognised by Adam have a suffix.
    """
    found: ByRun = {}
    at_split = exchanges[exchanges["split"] == below]
    suffixes = {"least squares": "", "Adam": "_adam", f"Adam, {below} slower": "_adam_slower"}
    for recognition, suffix in suffixes.items():
        own = at_split[at_split["recognition"] == recognition]
        for kind in ("first", "order"):
            rows = own[own["kind"] == kind]
            for level, side in (("cf", "lower"), ("cs", "upper")):
                found[f"{kind}_by_{level}{suffix}"] = _share(rows, rows["follows"] == side)
        both = [found[f"{name}{suffix}"] for name in ("first_by_cf", "order_by_cs")]
        smaller = pd.concat(both, axis=1).min(axis=1, skipna=False)
        found[f"separation{suffix}"] = smaller.astype(float)
    return found


def slow_followed(table: pd.DataFrame) -> list[str]:
    """Return the conditions in whose median run the top level is followed in any exchange."""
    shares = table[["first_by_cs", "order_by_cs"]].max(axis=1)
    middle = shares.groupby(table["condition"], sort=False).median()
    return [str(name) for name in middle.index[middle > 0]]


def spared(lesions: pd.DataFrame, below: str, top: str) -> ByRun:
    """Return the shares of right first strokes and of right ambiguous strokes, by lesion."""
    suffixes = {
        "none": "intact",
        f"{below}_0 to its mean": "without_cf",
        f"{top}_0 to its mean": "without_cs",
        f"{top} → {below} cut": "cut",
    }
    first = lesions["stroke"] == 1
    strokes = {"first": first, "branch": ~first & lesions["ambiguous"].astype(bool)}
    found: ByRun = {}
    for what, asked in strokes.items():
        for lesion, suffix in suffixes.items():
            rows = lesions[asked & (lesions["lesion"] == lesion)]
            found[f"{what}_{suffix}"] = _share(rows, rows["right"].astype(bool))
    return found


def read_out(symbols: pd.DataFrame, below: str) -> ByRun:
    """Return the share of sequences read out of a level, and of those that of right boundaries.

    They are read by the signatures of the lesson's strokes; with a suffix by those of primitives
    that are generated alone.
    """
    found: ByRun = {}
    for reference, suffix in (("taught", ""), ("alone", "_alone")):
        rows = symbols[(symbols["level"] == below) & (symbols["reference"] == reference)]
        right = rows[rows["edit_distance"] == 0]
        found[f"symbols_right{suffix}"] = _share(rows, rows["edit_distance"] == 0)
        within = right["boundary_error_steps"] <= WITHIN_STEPS
        found[f"boundaries_right{suffix}"] = _share(right, within)
    return found


def decoded(decoding: pd.DataFrame, below: str, top: str) -> ByRun:
    """Return the decoders' scores by what they read and from which level.

    That of the order is the mean over the rows before the ways part, where only memory can tell it.
    """
    rows = decoding.get("row", pd.Series(np.nan, index=decoding.index)).astype(float)
    before = rows < 0
    found: ByRun = {}
    for what in ("direction", "position", "order"):
        for name, level in (("cf", below), ("cs", top)):
            asked = (decoding["what"] == what) & (decoding["level"] == level)
            own = decoding[asked & before if what == "order" else asked]
            found[f"{what}_from_{name}"] = own.groupby(WHO)["score"].mean().astype(float)
    return found


def right_elements(loops: pd.DataFrame, below: str) -> "pd.Series[float]":
    """Return the share of motions that were taken to begin with what they do begin with."""
    column = f"begins_with_{below}"
    rows = loops.dropna(subset=[column]) if column in loops else loops.iloc[:0]
    pairs = zip(rows["motion"], rows.get(column, ()), strict=True)
    right = [str(motion).startswith(str(element)) for motion, element in pairs]
    return _share(rows, pd.Series(right, index=rows.index, dtype=bool))


def _share(rows: pd.DataFrame, right: "pd.Series[bool]") -> "pd.Series[float]":
    return right.astype(float).groupby([rows[name] for name in WHO]).mean()
