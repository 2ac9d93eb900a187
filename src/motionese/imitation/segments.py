"""Segments without labels: the strokes of a seen hand between its pauses, and who agrees on them.

Where the caregiver's hand pauses is seen by anyone, whatever the strokes are called. Pauses are
found as `motionese.kinematics` finds them, in the bearing of the hand; nothing is set for them.
"""

from collections.abc import Sequence
from typing import NamedTuple

from jaxtyping import Float
from numpy import ndarray

from motionese.kinematics import measure

WITHIN = 2
"""Two boundaries are the same one if they are so many rows apart, or fewer."""


def strokes_seen(seen: Float[ndarray, "T 2"], rate_hz: float) -> tuple[tuple[int, int], ...]:
    """Return the rows in which each stroke of a seen hand begins, and has ended.

    The second and later ones begin where a pause ends. None of a hand that does not move.

    Args:
        seen: Azimuth and elevation [rad]; NaN where it was not seen.
        rate_hz: Rows a second [Hz].
    """
    movements = measure(seen, rate_hz).movements
    rows = [(round(m.start_s * rate_hz), round(m.end_s * rate_hz)) for m in movements]
    return tuple((start, max(end, start + 1)) for start, end in rows)


class Agreement(NamedTuple):
    """How many boundaries were `found`, are `true`, and are `both`."""

    both: int
    found: int
    true: int


def agreement(found: Sequence[int], true: Sequence[int], within: int = WITHIN) -> Agreement:
    """Compare boundaries [rows, rising]; each is counted with one other at most."""
    left, both = list(true), 0
    for boundary in found:
        while left and left[0] < boundary - within:
            left.pop(0)
        if left and left[0] <= boundary + within:
            left.pop(0)
            both += 1
    return Agreement(both, len(found), len(true))
