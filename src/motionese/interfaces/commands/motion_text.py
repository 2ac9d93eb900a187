"""Motions in words, and what of them a network can express."""

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


def description(motions: Motions) -> str:
    """Return in words how many motions there are, of what length and rate, and what is missing."""
    shortest, longest = min(motions.lengths), max(motions.lengths)
    rows = f"{shortest}" if shortest == longest else f"{shortest} to {longest}"
    count = f"{len(motions)} motion{'' if len(motions) == 1 else 's'}"
    width = len(motions.channels)
    seen = sum(int(mask.sum()) for mask in motions.observed)
    gaps, beyond = 1 - seen / (sum(motions.lengths) * width), share_beyond(motions)
    return (
        f"{count} of {rows} rows at {motions.rate_hz:g} Hz, "
        f"{width} channel{'' if width == 1 else 's'}"
        + (f", {gaps:.1%} not observed" if gaps else "")
        + (f", {beyond:.1%} beyond their ranges and clipped" if beyond else "")
    )
