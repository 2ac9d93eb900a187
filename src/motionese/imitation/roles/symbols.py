"""Primitives as symbols: of which elements of its repertoire a motion consists inside the network.

An element's signature is the activity y of a level, row by row, while the network generates it. A
whole motion is read as signatures one after the other, without being told where one ends: each of
its rows lies beside a row of a signature, the following one beside the same row, the next, or the
next but one; after a signature's last row comes the first of any. Of all such readings it is the
one whose squared distances add up to the least. One-stage dynamic programming finds it (Vintsyuk
1971, Ney 1984), over rows t, elements e and rows r of their signatures s:

    D_t(e, r) = |y_t − s_er|² + min {D_t−1(e, r), D_t−1(e, r − 1), D_t−1(e, r − 2), E_t−1 if r = 0}
    E_t = min_e D_t(e, last row of e)

An element thus lasts half as long as its signature or longer (of L rows, ⌊L/2⌋ + 1), and is gone
through from first row to last. No price is set on a change: what is not there would have to be gone
through as a whole.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np
from jaxtyping import Float, Int
from numpy import ndarray

from motionese.imitation.loop import Row
from motionese.imitation.roles.generated import GeneratedMotion, generated
from motionese.imitation.roles.recognised import RecognisedLesson

ENTER = 3
"""How a reading comes to a signature's first row from the end of one; else the rows it goes on."""


@dataclass(frozen=True)
class ReadOut:
    """What was read: elements by name, and the rows at which the second and later ones begin."""

    symbols: tuple[str, ...]
    boundaries: tuple[int, ...]

    def boundary_error(self, begins: Sequence[int]) -> float:
        """Return how far [steps] the boundary that is most off is from where it is.

        Args:
            begins: The rows at which the elements begin, the first one included.

        Returns:
            NaN where not as many were read, or where there is but one.
        """
        if len(self.symbols) != len(begins) or not self.boundaries:
            return np.nan
        return float(np.abs(np.subtract(self.boundaries, begins[1:])).max())


class Reading(NamedTuple):
    """What was read of a motion in a level's activity, by one kind of signatures.

    Attributes:
        level: The level's name.
        reference: The kind of signatures, see `readings`.
        motion: What was read.
        read: As what.
        signs: Of all primitives there are, by name.
    """

    level: str
    reference: str
    motion: GeneratedMotion
    read: ReadOut
    signs: Mapping[str, str]


def readings(
    shown: RecognisedLesson, alone: RecognisedLesson, taught: RecognisedLesson
) -> list[Reading]:
    """Read what motions consist of from every level's activity.

    It is read by two kinds of signatures, never by those of the demonstration that is read:

    - "alone": of primitives that the network generates by themselves.
    - "taught": those, and the primitives in the motions of a lesson, where demonstrations have
      their boundaries.

    IO's activity is the motion itself, and tells what could be read if a level held all of it.

    Args:
        shown: The motions that are read.
        alone: Single primitives, recognised by the same network.
        taught: The lesson; it may be `shown`.

    Returns:
        One for each level, kind of signatures and motion. None for a level whose activity is the
        same in all signatures.
    """
    motions, by_itself, in_lesson = (generated(each) for each in (shown, alone, taught))
    references = {"alone": by_itself, "taught": by_itself + in_lesson}
    found = []
    for level, (name, reference) in product(shown.network.names, references.items()):
        own = shown.network.units(level)
        for motion in motions:
            this = motion.sequence, motion.number
            others = [m for m in reference if (m.sequence, m.number) != this]
            signatures = [each for m in others for each in m.strokes(own)]
            if signatures and np.ptp(np.concatenate([s for _, s in signatures]), axis=0).any():
                read = read_out(motion.activity[:, own], signatures)
                signs = {p.name: p.sign for m in (motion, *others) for p in m.sequence.primitives}
                found.append(Reading(level, name, motion, read, signs))
    return found


def symbols_read(read: Iterable[Reading]) -> list[Row]:
    """Return a row for each reading, compared with what was shown.

    Its signs as `read` and as they are (`true`), the edit distance of the primitives, the error of
    the boundary that is most off [steps].
    """
    return [
        {
            "level": each.level,
            "reference": each.reference,
            **_compared(each.motion, each.read, each.signs),
        }
        for each in read
    ]


def _compared(motion: GeneratedMotion, read: ReadOut, signs: Mapping[str, str]) -> Row:
    """Return what was read of a motion beside what it is."""
    true = [p.name for p in motion.sequence.primitives]
    return {
        "motion": motion.sequence.name,
        "demonstration": motion.number,
        "read": "".join(signs[name] for name in read.symbols),
        "true": "".join(signs[name] for name in true),
        "edit_distance": edit_distance(read.symbols, true),
        "boundary_error_steps": read.boundary_error(motion.begins),
    }


def edit_distance(one: Sequence[str], other: Sequence[str]) -> int:
    """Return the fewest symbols put in, left out or replaced that make one the other."""
    row = list(range(len(other) + 1))  # from the symbols of one so far, none, to the first of other
    for done, symbol in enumerate(one, start=1):
        above, row = row, [done]
        for place, wanted in enumerate(other):
            swapped = above[place] + (symbol != wanted)
            row.append(min(swapped, above[place + 1] + 1, row[place] + 1))
    return row[-1]


def read_out(
    activity: Float[ndarray, "T n"], signatures: Sequence[tuple[str, Float[ndarray, "_ n"]]]
) -> ReadOut:
    """Read the elements that a motion's activity consists of.

    Args:
        activity: The activity of a level, row by row.
        signatures: That of elements, each with the element's name; an element may have several.

    Returns:
        What was read; nothing of a motion that is not half as long as any signature.
    """
    last = np.array([len(signature) for _, signature in signatures]) - 1
    cost = np.full((len(activity), len(last), last.max() + 1), np.inf)
    for e, (_, signature) in enumerate(signatures):
        cost[:, e, : len(signature)] = ((activity[:, None] - signature) ** 2).sum(axis=-1)
    ended, came, total = _forward(cost, last)
    e = int(total.argmin())
    if not np.isfinite(total[e]):
        return ReadOut((), ())
    row, read, boundaries = last[e], [e], []
    for t in range(len(activity) - 1, 0, -1):
        way = came[t - 1][e, row]
        if way == ENTER:
            e = ended[t - 1]
            row = last[e]
            read.append(e)
            boundaries.append(t)
        else:
            row -= way
    return ReadOut(tuple(signatures[e][0] for e in reversed(read)), tuple(reversed(boundaries)))


def _forward(
    cost: Float[ndarray, "T E L"], last: Int[ndarray, " E"]
) -> tuple[list[int], list[Int[ndarray, "E L"]], Float[ndarray, " E"]]:
    """Go through the rows of a motion.

    Returns:
        For every row but the last, which element ends best there, and how the next row's readings
        come from it (rows back, or `ENTER`); D_T of every element's last row.
    """
    every, is_first = np.arange(len(last)), np.arange(cost.shape[2]) == 0
    best = np.where(is_first, cost[0], np.inf)
    ended, came = [], []
    for now in cost[1:]:
        ends = best[every, last]
        back = [np.pad(best, ((0, 0), (rows, 0)), constant_values=np.inf) for rows in (0, 1, 2)]
        ways = [each[:, : best.shape[1]] for each in back]
        ways.append(np.broadcast_to(np.where(is_first, ends.min(), np.inf), best.shape))
        ended.append(int(ends.argmin()))
        came.append(np.argmin(ways, axis=0))
        best = np.min(ways, axis=0) + now
    return ended, came, best[every, last]
