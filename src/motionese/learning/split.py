"""Motions to learn from, and motions held out to test what was learned."""

from collections.abc import Sequence

import numpy as np

from motionese.arguments import place_of, refusing, several
from motionese.errors import MotionError
from motionese.learning.motions.motions import Motions

ENOUGH = 5
"""From so many motions on one at least is held out by default."""


@refusing(MotionError)
def split(
    motions: Motions, held_out: float | Sequence[str | int] | str | None = None, *, seed: int = 0
) -> tuple[Motions, Motions | None]:
    """Return the motions to learn and those held out, each in their order; None for none.

    Args:
        motions: All motions.
        held_out: A share of them, drawn at random (one at least unless it is 0), or their names or
            numbers from 0; where left out those that the recording sets apart; else a tenth, none
            of fewer than five.
        seed: Of the draw.

    Raises:
        MotionError: A share outside 0 to below 1, a name that no motion has, or nothing left to
            learn.
    """
    count = len(motions)
    if held_out is None:
        held_out = motions.set_apart or (0.1 if count >= ENOUGH else 0.0)
    if isinstance(held_out, int | float | np.number):
        if not 0 <= held_out < 1:
            raise MotionError(
                f"held out {held_out:g}: a share of the motions from 0 to below 1, or their names"
            )
        number = max(round(held_out * count), 1) if held_out else 0
        chosen = {motions.names[i] for i in np.random.default_rng(seed).permutation(count)[:number]}
    else:
        named = several(held_out)
        places = [place_of("motion", one, motions.names, MotionError) for one in named]
        chosen = set(motions.chosen(places).names)
    learned = [name for name in motions.names if name not in chosen]
    if not learned:
        is_share = isinstance(held_out, int | float | np.number)
        told = f"{held_out:g}" if is_share else ", ".join(sorted(chosen))
        raise MotionError(
            f"held out {told}: leaves no motion to learn; --held-out 0 holds none out"
        )
    if not chosen:
        return motions, None
    return motions.chosen(learned), motions.chosen([n for n in motions.names if n in chosen])
