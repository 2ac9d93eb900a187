"""What a network can express: a little more than the ranges of its channels."""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.channels import Channels
from motionese.learning import Motions
from motionese.unit_interval import CLIP_HIGH, CLIP_LOW


def reach(channels: Channels) -> tuple[Float[ndarray, " D"], Float[ndarray, " D"]]:
    """Return the lowest and highest value of every channel; what lies beyond is clipped."""
    ends = np.full((2, len(channels)), [[CLIP_LOW], [CLIP_HIGH]])
    lowest, highest = channels.from_unit(ends)
    return lowest, highest


def share_beyond(motions: Motions) -> float:
    """Return the share of what was observed that is clipped, as the ranges are too narrow."""
    lowest, highest = reach(motions.channels)
    clipped = [
        mask & ((values < lowest) | (values > highest))
        for values, mask in zip(motions.values, motions.observed, strict=True)
    ]
    seen = sum(int(mask.sum()) for mask in motions.observed)
    return sum(int(cells.sum()) for cells in clipped) / max(seen, 1)
