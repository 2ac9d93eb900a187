"""How many rows it takes to pass from one motion to another, about as fast as they are."""

from dataclasses import dataclass

import numpy as np
from numpy import ndarray

from motionese.minimum_jerk import transition_rows
from motionese.runtime.model import RuntimeModel
from motionese.runtime.player import Player


@dataclass(frozen=True, eq=False)
class Course:
    """A motion by itself, in closed loop from where it was recorded, in the channels' units.

    Attributes:
        first: Its first row. [D]
        speed: The largest change of every channel from one row to the next. [D]
        rows: How many it has.
    """

    first: ndarray
    speed: ndarray
    rows: int


def course(model: RuntimeModel, start: str | ndarray, rows: int) -> Course:
    """Play a motion of so many rows by itself; about 15 µs a row."""
    player, nothing = Player(model, model.begin(start)), np.full(len(model.channels), np.nan)
    first = before = player.row
    speed = np.zeros_like(first)
    for _ in range(rows - 1):
        row = player.step_unit(nothing)
        np.maximum(speed, np.abs(row - before), out=speed)
        before = row
    return Course(first, speed, rows)


@dataclass(frozen=True, eq=False)
class Transition:
    """From one motion to another, as long as the library's `generate_sequence` makes it."""

    former: Course
    latter: Course

    def rows_from(self, here: ndarray) -> int:
        """Return how many rows it takes from here [D], at most half of the later motion's.

        It takes so many, too, where a channel stands still in both motions, at different places.
        """
        speed = np.maximum(self.former.speed, self.latter.speed)
        apart = np.abs(self.latter.first - here)
        return transition_rows(apart, speed, self.latter.rows // 2)
