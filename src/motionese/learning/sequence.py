"""One motion after another without a jump: each begins where the one before it is."""

from collections.abc import Mapping, Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import ChannelError, SettingError
from motionese.learning.generate import generate
from motionese.learning.placed import placed
from motionese.network import MTRNN

PEAK = 1.875
"""The largest slope of the blend's weight 10 s³ − 15 s⁴ + 6 s⁵."""
SHORTEST = 10
"""Rows of the shortest transition: a motion that begins elsewhere needs some to find its way."""


def generate_sequence(
    network: MTRNN,
    initial_states: Sequence[Float[ndarray, " N"]] | Float[ndarray, "M N"],
    steps: Sequence[int],
    *,
    blend: int | None = None,
    duration: float = 1.0,
    here: Mapping[str, float] | None = None,
) -> Float[ndarray, "T D"]:
    """Generate motions one after another in closed loop, blending each into the next.

    A motion begins with its IO units where the one before it has come to, and with its own
    context. While the one before goes on for some rows, the path passes from it to the next with
    the weight 10 s³ − 15 s⁴ + 6 s⁵ (no velocity and no acceleration at either end).

    Args:
        network: A network that carries channels.
        initial_states: u_0 of all levels, one for every motion.
        steps: Rows of every motion; the blend is part of the later one.
        blend: Rows of a transition. Where left out, as many as it needs to be about as fast as
            the two motions themselves, up to half of the later one.
        duration: How many times as long the motions last, see `generate`.
        here: Where the robot is, by channel, in the channels' units: it sets out from standing
            still there, in a transition as between motions. Where left out, the first motion
            begins where it was recorded, as it was.

    Returns:
        One path of as many rows as all motions have, in the channels' units.

    Raises:
        SettingError: No motions, not one number of steps for each, fewer than 2 steps, or no more
            than the blend.
    """
    if not len(initial_states) or len(steps) != len(initial_states):
        raise SettingError(
            f"a sequence needs motions and one number of steps for each, "
            f"got {len(initial_states)} and {len(steps)}"
        )
    if min(steps) < 2:
        raise SettingError(f"steps must be ≥ 2, got {min(steps)}")
    if blend is not None and not 0 <= blend < min(steps):
        raise SettingError(
            f"the blend must be ≥ 0 and shorter than every motion ({min(steps)} rows), got {blend}"
        )
    if network.channels is None:
        raise ChannelError("the network carries no channels; train it on motions first")
    names, longest = network.channels.names, max(steps)
    whole = generate(network, initial_states[0], steps[0] + longest, duration=duration)
    former = whole[: steps[0]]
    if here is not None:
        whole = _set_out(network, initial_states[0], whole, steps[0], here, blend, duration)
    for state, rows in zip(initial_states[1:], steps[1:], strict=True):
        before, passing = np.split(whole, [len(whole) - longest])
        over = blend
        if over is None:
            own = generate(network, state, rows + longest, duration=duration)[:rows]
            needed = _rows_to_blend(former, own, passing[0])
            over, former = int(min(max(needed, SHORTEST), rows // 2)), own
        left = dict(zip(names, passing[0], strict=True))
        path = generate(network, placed(network, state, left), rows + longest, duration=duration)
        weight = _minimum_jerk(over)[:, None]
        path[:over] = (1 - weight) * passing[:over] + weight * path[:over]
        whole = np.concatenate([before, path])
    return whole[:-longest]


def _set_out(
    network: MTRNN,
    state: Float[ndarray, " N"],
    own: Float[ndarray, "T D"],
    rows: int,
    here: Mapping[str, float],
    blend: int | None,
    duration: float,
) -> Float[ndarray, "T D"]:
    """Return a motion that begins by standing still here, instead of its own path."""
    path = generate(network, placed(network, state, here), len(own), duration=duration)
    standing, over = path[0].copy(), blend
    if network.channels is not None:
        standing[network.channels.indices(here)] = list(here.values())
    if over is None:
        needed = _rows_to_blend(own[:rows], own[:rows], standing)
        over = int(min(max(needed, SHORTEST), rows // 2))
    weight = _minimum_jerk(over)[:, None]
    path[:over] = (1 - weight) * standing + weight * path[:over]
    return path


def _rows_to_blend(
    before: Float[ndarray, "S D"], after: Float[ndarray, "T D"], here: Float[ndarray, " D"]
) -> float:
    """Return the rows in which a transition is no faster than the motions it connects.

    Infinitely many where a channel stands still in both, at different places.
    """
    speed = np.maximum(*(np.abs(np.diff(path, axis=0)).max(0) for path in (before, after)))
    apart = np.abs(after[0] - here)
    still = np.where(apart > 0, np.inf, 0.0)
    rows = np.divide(apart, speed, out=still, where=speed > 0)
    return float(np.ceil(PEAK * rows.max()))


def _minimum_jerk(rows: int) -> Float[ndarray, " B"]:
    """Return the weight of what follows in every row of a blend, from 0 towards 1."""
    s = np.arange(rows) / max(rows, 1)
    return np.asarray(10 * s**3 - 15 * s**4 + 6 * s**5)
