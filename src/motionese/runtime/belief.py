"""Belief: which learned motion is being shown, and how far it has come, as readings arrive.

A hidden Markov model whose states are the rows of all learned motions, as the network itself
generates them, and one more for none of these. From reading to reading a motion goes on by a row,
now and then by none or by two, and seldom becomes another; a reading lies around its row with a
known accuracy, or, where it is none of these, anywhere in the channels' ranges. The forward
algorithm (Rabiner 1989) sums this up in a few vector operations a reading.
"""

from collections.abc import Mapping

import numpy as np
from numpy import ndarray

from motionese.unit_interval import INNER_HIGH, INNER_LOW

NONE = "none of these"
STAYS, LEAPS = 0.05, 0.05
"""How likely a motion stays in its row for a reading, and leaps over one."""
CHANGES = 0.05
"""How likely it becomes another, or none, at any reading."""
ANEW = 0.7
"""How likely a motion that is seen for the first time is seen from its beginning."""


class Belief:
    """What is believed after the readings so far.

    Attributes:
        names: The learned motions' names.
        none: How likely none of them is being shown.
    """

    def __init__(self, paths: Mapping[str, ndarray], accuracy: float) -> None:
        """Know some motions.

        Args:
            paths: Every motion's rows in the unit interval. [L, D] each
            accuracy: Standard deviation of a reading from a motion's row, in the unit interval.
        """
        self.names = tuple(paths)
        self._rows = np.concatenate(list(paths.values()))
        lengths = np.array([len(path) for path in paths.values()])
        self._last = np.cumsum(lengths) - 1
        self._first = self._last - lengths + 1
        place = np.arange(len(self._rows)) - np.repeat(self._first, lengths)
        self._from_before = np.where(place >= 1, 1 - STAYS - LEAPS, 0.0)[1:]
        self._leaping = np.where(place >= 2, LEAPS, 0.0)[2:]
        self._accuracy = accuracy
        anywhere = np.full(len(self._rows), 1 / len(self._rows))
        beginning = np.where(place == 0, 1 / len(lengths), 0.0)
        self._anew = (1 - CHANGES) * anywhere
        self._shares = (1 - CHANGES) * (ANEW * beginning + (1 - ANEW) * anywhere)
        self.none, self._begun = CHANGES, False

    def observe(self, row: ndarray) -> None:
        """Take in what is sensed [D] in the unit interval; NaN where nothing is."""
        if self._begun:
            self._pass()
        self._begun = True
        seen = np.flatnonzero(np.isfinite(row))
        deviations = (self._rows[:, seen] - row[seen]) / self._accuracy
        # Both are densities; the Gaussian's constant stands with the other.
        none = len(seen) * np.log(self._accuracy * np.sqrt(2 * np.pi) / (INNER_HIGH - INNER_LOW))
        costs = -0.5 * np.einsum("rd,rd->r", deviations, deviations)
        best = max(float(costs.max()), none)
        self._shares = self._shares * np.exp(costs - best)
        self.none = self.none * float(np.exp(none - best))
        total = self._shares.sum() + self.none
        self._shares, self.none = self._shares / total, self.none / total

    def _pass(self) -> None:
        """Let the time from one reading to the next pass."""
        now = self._shares
        later = STAYS * now
        later[1:] += self._from_before * now[:-1]
        later[2:] += self._leaping * now[:-2]
        later[self._last] += (1 - STAYS) * now[self._last]  # a motion that has ended rests
        changed = CHANGES * (now.sum() + self.none)
        self._shares = (1 - CHANGES) * later + changed * self._anew
        self.none = (1 - CHANGES) * self.none + changed * CHANGES

    @property
    def shares(self) -> dict[str, float]:
        """How likely every motion is being shown, and none of them; the sum is 1."""
        each = np.add.reduceat(self._shares, self._first)
        return dict(zip(self.names, each.tolist(), strict=True)) | {NONE: float(self.none)}

    @property
    def likeliest(self) -> tuple[str, int]:
        """The likeliest motion's name, and the row that it has most likely come to."""
        motion = int(np.add.reduceat(self._shares, self._first).argmax())
        first, last = self._first[motion], self._last[motion]
        return self.names[motion], int(self._shares[first : last + 1].argmax())
