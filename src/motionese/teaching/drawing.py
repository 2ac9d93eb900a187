"""A drawing becomes a demonstration: the hand's path at the body's rate, in the robot's tempo.

A person moves at a tempo of their own, the network knows one. Before the robot watches a drawing,
still time is cut as the scripted caregiver cuts it, and what is left is played at the mean speed of
that caregiver's hand.
"""

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import Manner, lasting, moving, stroke_length
from motionese.errors import MotioneseError
from motionese.task import Task

LONGEST_S, MOST_POINTS = 20.0, 4000
"""Limits of one drawing."""
SHORTEST_M = 0.06
"""Shorter ways are slips of the pen."""
MOST_STROKES = 6
"""A demonstration is at most as long as so many strokes."""
FINE_HZ = 100.0
QUICKEST_S = 1.0
"""A quicker drawing is slowed to last so long: it would have no rows between its ends."""


class DrawingError(MotioneseError):
    """A drawing that is too short or too long to be shown; the text says so kindly."""


class Drawing:
    """The points of one drawing, as they come."""

    def __init__(self) -> None:
        """Begin with no points."""
        self._points: list[tuple[float, float, float]] = []
        self.full = False
        """Whether points were left out, because there were too many or it lasted too long."""

    def __len__(self) -> int:
        return len(self._points)

    def add(self, points: list[tuple[float, float, float]]) -> None:
        """Take further points: time [ms], never falling, and x, y in the view."""
        for point in points:
            begin = self._points[0][0] if self._points else point[0]
            late = point[0] - begin > 1000 * LONGEST_S
            self.full = self.full or late or len(self._points) == MOST_POINTS
            if not self.full:
                self._points.append(point)

    @property
    def seconds(self) -> float:
        """How long it has lasted [s]."""
        return (self._points[-1][0] - self._points[0][0]) / 1000 if self._points else 0.0

    def sampled(self, rate_hz: float) -> Float[ndarray, "R 2"]:
        """Return x, y at an even rate, each row the mean over the interval around it."""
        times, *places = np.array(self._points).T
        times, kept = np.unique((times - times[0]) / 1000, return_index=True)
        times = times * max(1.0, QUICKEST_S / times[-1]) if times[-1] else times
        fine = np.arange(0.0, times[-1] + 1 / FINE_HZ, 1 / FINE_HZ)
        width = round(FINE_HZ / rate_hz)
        rows = np.arange(0, len(fine) + width - 1, width)  # the last is not before the end
        columns = []
        for place in places:
            even = np.interp(fine, times, place[kept])
            # Ends are held, so that the first row is where the pen was set down.
            held = np.pad(even, (width // 2, 2 * width), mode="edge")
            columns.append(np.convolve(held, np.full(width, 1 / width), mode="valid")[rows])
        return np.stack(columns, axis=-1)


def at_tempo(drawn: Float[ndarray, "R 3"], task: Task, manner: Manner) -> Float[ndarray, "T 3"]:
    """Return a drawn path [m, world] at the tempo of the scripted caregiver.

    Raises:
        DrawingError: The way is too short, or as long as too many strokes.
    """
    moved = moving(drawn, manner.rest_steps)
    length = float(np.linalg.norm(np.diff(moved, axis=0), axis=1).sum())
    if length < SHORTEST_M:
        raise DrawingError("That was very short: draw from one place to another.")
    rows = round(length / stroke_length(task) * manner.primitive_rows)
    if rows > most_rows(manner):
        raise DrawingError(
            f"That was longer than {MOST_STROKES} strokes: show fewer of them in one go."
        )
    return lasting(moved, max(rows, 3))


def most_rows(manner: Manner) -> int:
    """Return the rows of the longest demonstration."""
    return MOST_STROKES * manner.primitive_rows
