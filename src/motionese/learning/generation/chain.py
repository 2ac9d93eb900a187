"""One motion after another without a jump: each begins where the one before it is."""

from collections.abc import Mapping, Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.errors import ChannelError, SettingError
from motionese.learning.generation.generate import generate, placed
from motionese.minimum_jerk import minimum_jerk, transition_rows
from motionese.network import MTRNN


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
            apart = np.abs(own[0] - passing[0])
            over, former = transition_rows(apart, _speed(former, own), rows // 2), own
        left = dict(zip(names, passing[0], strict=True))
        path = _from_here(network, state, left, rows + longest, duration)
        weight = _weight(over)
        path[:over] = (1 - weight) * passing[:over] + weight * path[:over]
        whole = np.concatenate([before, path])
    return whole[:-longest]


def _from_here(
    network: MTRNN,
    state: Float[ndarray, " N"],
    here: Mapping[str, float],
    rows: int,
    duration: float,
) -> Float[ndarray, "T D"]:
    """Generate a motion that begins where the robot is: this is its first input, as in training."""
    there = placed(network, state, here)
    assert network.channels is not None, "placed refuses a network without channels"
    first = np.array([here.get(name, np.nan) for name in network.channels.names])
    return generate(network, there, rows, first=first, duration=duration)


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
    path = _from_here(network, state, here, len(own), duration)
    standing, over = path[0].copy(), blend
    if network.channels is not None:
        standing[network.channels.indices(here)] = list(here.values())
    if over is None:
        over = transition_rows(np.abs(own[0] - standing), _speed(own[:rows]), rows // 2)
    weight = _weight(over)
    path[:over] = (1 - weight) * standing + weight * path[:over]
    return path


def _speed(*paths: Float[ndarray, "_ D"]) -> Float[ndarray, " D"]:
    """Return every channel's largest change from one row of some path to the next."""
    return np.asarray(np.max([np.abs(np.diff(path, axis=0)).max(0) for path in paths], axis=0))


def _weight(rows: int) -> Float[ndarray, "B 1"]:
    """Return the weight of what follows in every row of a transition, from 0 towards 1."""
    return minimum_jerk(np.arange(rows) / max(rows, 1))[:, None]
