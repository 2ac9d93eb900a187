"""What motions themselves let a network predict, whatever it is: forks in them, and their noise.

Both are measured in shares of the channels' ranges: d(a, b) is the root mean square over the
channels of what two rows differ by.
"""

from collections.abc import Iterator

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.learning.motions.motions import Motions

STILL = 0.1
"""Rows that move less than this share of the root mean square of all steps are left out of ways."""
STEP = 0.06
"""Root mean square of the steps of a way: rows are made more or fewer for it, whatever the rate."""
AHEAD = 10
"""Rows of a way that are looked ahead."""
NEAR, APART = 0.05, 0.2
"""Ways are at the same state within the first, and have parted beyond the second."""
TURN = 2.0
"""How much a difference in the last step counts beside one in position, in a state."""
BETWEEN = 3
"""Two forks of a motion are so many rows apart at least."""
MOST_MOTIONS = 1_000
"""Motions that are looked at, at most."""
MOST, COMPARED = 8_000, 50
"""Rows of all ways, and neighbours of one, beyond which only some are looked at."""


def forks(motions: Motions) -> float:
    """Return how often a motion forks: after the same state motions go on differently.

    A state of a way is z = (x_t, TURN (x_t − x_{t−1})); ways are motions without their still rows,
    so that it does not matter how long one waits. Two states, of two motions or of one at two
    times, are the same if d(z, z') ≤ NEAR (false nearest neighbours, Kennel et al. 1992); their
    ways part if d(x_{t+a}, x'_{t'+a}) > APART for an a ≤ AHEAD, and the fork lies in the last row
    before, where they were still together. A motion's forks are counted, rows nearer than BETWEEN
    as one, and the mean over the motions is returned.

    One fork a motion is what initial states are for. Many of them a network has to learn by heart,
    motion by motion: from what it has seen it cannot be told what follows.

    Rows in which a channel was not observed are left out; of very many motions `MOST_MOTIONS`,
    evenly spread, are looked at.
    """
    ways = _ways(_some(motions))
    if not any(len(way) > 1 for way in ways):
        return 0.0
    states, futures, places = _windows(ways)
    found: list[set[int]] = [set() for _ in ways]
    for (motion, row), parting in _partings(states, futures, places):
        found[motion].add(row + parting)
    counts = [1 + (np.diff(sorted(rows)) >= BETWEEN).sum() if rows else 0 for rows in found]
    return float(np.mean(counts))


def row_noise(motions: Motions) -> float:
    """Return the standard deviation of what scatters from row to row, as a share of range.

    A fourth difference takes away what is smooth; of independent noise it leaves 70 times the
    variance (the variate-difference method: Anderson 1971, chapter 3). No prediction of rows comes
    nearer than that. NaN where no five rows in sequence were observed. Of very many motions
    `MOST_MOTIONS`, evenly spread, are looked at.
    """
    motions = _some(motions)
    left = [
        np.diff(np.where(seen, values, np.nan) / motions.channels.spans, 4, axis=0)
        for values, seen in zip(motions.values, motions.observed, strict=True)
    ]
    known = np.concatenate(left)
    known = known[~np.isnan(known)]
    return float(np.sqrt((known**2).mean() / 70)) if len(known) else float("nan")


def _some(motions: Motions) -> Motions:
    few = np.linspace(0, len(motions) - 1, min(MOST_MOTIONS, len(motions))).astype(int)
    return motions.chosen(few.tolist())


def _size(differences: Float[ndarray, "*T D"]) -> Float[ndarray, "*T"]:
    return np.asarray(np.sqrt((differences**2).mean(-1)))


def _ways(motions: Motions) -> list[Float[ndarray, "_ D"]]:
    """Return every motion as a way: no gaps, no still rows, steps of one size in the mean."""
    shares = [
        value[seen.all(axis=1)] / motions.channels.spans
        for value, seen in zip(motions.values, motions.observed, strict=True)
    ]
    steps = np.concatenate([_size(np.diff(way, axis=0)) for way in shares])
    least = STILL * np.sqrt((steps**2).mean()) if len(steps) else 0.0
    moving = steps[steps > least]
    if not len(moving):
        return []
    pace = STEP / np.sqrt((moving**2).mean())
    total = sum(map(len, shares)) / pace
    ways = []
    for way in shares[:: max(int(np.ceil(total / MOST)), 1)]:
        at = np.arange(0, max(len(way) - 1, 0) + 1e-9, pace)
        fine = (
            np.stack([np.interp(at, np.arange(len(way)), c) for c in way.T], 1) if len(way) else way
        )
        kept = _size(np.diff(fine, axis=0)) > least * pace
        ways.append(fine[np.concatenate([[True] * min(len(fine), 1), kept])])
    return ways


def _windows(
    ways: list[Float[ndarray, "_ D"]],
) -> tuple[Float[ndarray, "K Z"], Float[ndarray, "K A D"], Int[ndarray, "K 2"]]:
    """Return all states, what follows each (NaN after the end), and the way and row of each."""
    states, futures, places = [], [], []
    for number, way in enumerate(ways):
        longer = np.pad(way, ((0, AHEAD), (0, 0)), constant_values=np.nan)
        for row in range(1, len(way)):
            states.append(np.concatenate([way[row], TURN * (way[row] - way[row - 1])]))
            futures.append(longer[row : row + AHEAD + 1])
            places.append((number, row))
    return np.array(states), np.array(futures), np.array(places)


def _partings(
    states: Float[ndarray, "K Z"], futures: Float[ndarray, "K A D"], places: Int[ndarray, "K 2"]
) -> Iterator[tuple[Int[ndarray, " 2"], int]]:
    """Yield the place of every state whose way parts from another's, and how many rows later."""
    # SciPy takes long to import, and few who train ask for this.
    from scipy.spatial import cKDTree  # noqa: PLC0415

    reach = NEAR * np.sqrt(futures.shape[-1])
    for place, future, near in zip(
        places, futures, cKDTree(states).query_ball_point(states, reach), strict=True
    ):
        few = np.array(near)[np.linspace(0, len(near) - 1, min(len(near), COMPARED)).astype(int)]
        same = (places[few, 0] == place[0]) & (abs(places[few, 1] - place[1]) <= AHEAD)
        apart = _size(futures[few[~same]] - future)
        for distances in apart[(apart > APART).any(axis=1)]:
            parted = int((distances > APART).argmax())
            together = np.flatnonzero(distances[:parted] <= 1.5 * NEAR)
            if len(together):
                yield place, int(together[-1])
