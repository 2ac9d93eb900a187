"""A performance is played: its frames are sent in real time."""

import time
from collections.abc import Callable, Iterator

from motionese.interfaces.teach.states import Told
from motionese.teaching.frames import Film

PART_S = 0.2
"""Frames are sent in parts of so many seconds, each when it is due."""


def frames_told(played: Film, tell: Callable[[Told], None]) -> Iterator[float]:
    """Send a film part by part; yields how long [s] to wait before the next."""
    size = round(PART_S * played.rate_hz)
    began = time.monotonic()
    for row in range(0, len(played), size):
        last = row + size >= len(played)
        frames = {"from": row, "rate_hz": played.rate_hz, "last": last}
        tell({"type": "frames", **frames, **played.part(row, row + size)})
        yield max(0.0, began + (row + size) / played.rate_hz - time.monotonic())
