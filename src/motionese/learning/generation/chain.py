"""One motion after another without a jump: each begins where the one before it is."""

from collections.abc import Mapping, Sequence

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.arguments import refusing
from motionese.errors import SettingError
from motionese.learning.generation.generate import carried, generate, placed
from motionese.minimum_jerk import minimum_jerk, transition_rows
from motionese.network import MTRNN, Trained, network_of


@refusing()
def generate_sequence(
    network: MTRNN | Trained,
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
        network: A network that carries channels, or what training left.
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
    network = network_of(network)
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
    channels, longest = carried(network), max(steps)

    def from_here(state: ndarray, here: Mapping[str, float], rows: int) -> ndarray:
        # Where the robot is is the first input, as in training.
        first = np.array([here.get(name, np.nan) for name in channels.names])
        return generate(network, placed(network, state, here), rows, first=first, duration=duration)

    whole = generate(network, initial_states[0], steps[0] + longest, duration=duration)
    former = whole[: steps[0]]
    if here is not None:
        whole = from_here(initial_states[0], here, len(whole))
        standing, over = whole[0].copy(), blend
        standing[channels.indices(here)] = list(here.values())
        if over is None:
            over = transition_rows(np.abs(former[0] - standing), _speed(former), steps[0] // 2)
        whole[:over] = _passed(standing, whole[:over])
    for state, rows in zip(initial_states[1:], steps[1:], strict=True):
        before, passing = np.split(whole, [len(whole) - longest])
        over = blend
        if over is None:
            own = generate(network, state, rows + longest, duration=duration)[:rows]
            apart = np.abs(own[0] - passing[0])
            over, former = transition_rows(apart, _speed(former, own), rows // 2), own
        path = from_here(state, dict(zip(channels.names, passing[0], strict=True)), rows + longest)
        path[:over] = _passed(passing[:over], path[:over])
        whole = np.concatenate([before, path])
    return channels.held(whole[:-longest])


def _speed(*paths: Float[ndarray, "_ D"]) -> Float[ndarray, " D"]:
    """Return every channel's largest change from one row of some path to the next."""
    return np.asarray(np.max([np.abs(np.diff(path, axis=0)).max(0) for path in paths], axis=0))


def _passed(before: Float[ndarray, "... D"], after: Float[ndarray, "B D"]) -> Float[ndarray, "B D"]:
    """Pass from a path, or from standing still, to another, whose weight rises from 0 towards 1."""
    weight = minimum_jerk(np.arange(len(after)) / max(len(after), 1))[:, None]
    return np.asarray((1 - weight) * before + weight * after)
