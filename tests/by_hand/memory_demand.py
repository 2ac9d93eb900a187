"""Memory demand by the chain rule, H(next | c) = H(c, next) − H(c), from counts of joint names."""

import numpy as np


def entropy(names):
    """Entropy of how often each name is there. [bit]"""
    _, counts = np.unique(names, return_counts=True)
    shares = counts / counts.sum()
    return float(-(shares * np.log2(shares)).sum())


def conditional(known, following):
    """Entropy of what follows to one who knows. [bit]"""
    both = [f"{k} then {f}" for k, f in zip(known, following, strict=True)]
    return entropy(both) - entropy(known)


def memory_demand(walks, primitive_rows):
    """D_corner, D_last, D_history [bit], hold [rows], load [bit · rows].

    Args:
        walks: Every sequence as places and primitives' names in turn: UR, PUSH(R), LR, …
        primitive_rows: Rows of every primitive.
    """
    corner, last, history, following = [], [], [], []
    for walk in walks:
        for at in range(2, len(walk) - 1, 2):
            corner.append(walk[at])
            last.append(" ".join(walk[at - 1 : at + 1]))
            history.append(" ".join(walk[: at + 1]))
            following.append(walk[at + 1])
    if not following:
        return 0.0, 0.0, 0.0, 0, 0.0
    hold, load = 0, 0.0
    for past in set(history):
        ways = [f for h, f in zip(history, following, strict=True) if h == past]
        rows = primitive_rows * (len(past.split()) // 2)
        load += len(ways) / len(following) * entropy(ways) * rows
        hold = max(hold, rows if len(set(ways)) > 1 else 0)
    known = (conditional(each, following) for each in (corner, last, history))
    return *known, hold, load
