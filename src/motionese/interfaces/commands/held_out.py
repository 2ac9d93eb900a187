"""Which motions are held out of training."""

import numpy as np

from motionese.errors import SettingError
from motionese.learning import Motions

ENOUGH = 5
"""From so many motions on one at least is held out by default."""


def split(motions: Motions, held_out: str | None, seed: int) -> tuple[Motions, Motions | None]:
    """Return the motions to learn and those held out.

    Args:
        motions: All motions.
        held_out: A share of them, drawn at random, or names with commas between them; a tenth
            where left out, none of fewer than five. A number below 1 is a share whatever the
            motions are called.
        seed: Of the draw.

    Raises:
        SettingError: A share outside 0 to 1, or nothing left to learn.
        MotionError: A name that no motion has.
    """
    count = len(motions)
    if held_out is None:
        held_out = "0.1" if count >= ENOUGH else "0"
    share = _number(held_out)
    if share is not None and 0 <= share < 1:
        number = max(round(share * count), 1) if share else 0
        drawn = np.random.default_rng(seed).permutation(count)[:number]
        chosen = {motions.names[i] for i in drawn}
    elif share is not None and held_out not in motions.names:
        raise SettingError(
            f"--held-out {held_out}: a share of the motions from 0 to below 1, or their names"
        )
    else:
        chosen = set(motions.chosen([name.strip() for name in held_out.split(",")]).names)
    learned = [name for name in motions.names if name not in chosen]
    if not learned:
        raise SettingError(f"--held-out {held_out}: leaves no motion to learn")
    if not chosen:
        return motions, None
    unseen = [name for name in motions.names if name in chosen]
    return motions.chosen(learned), motions.chosen(unseen)


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
