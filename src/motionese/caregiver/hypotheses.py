"""Hypotheses about what a hand shows: one of the ways that are known, or something else.

A person's hand strays from the way that it means by σ = 2 cm along either axis of the surface it
moves on, and smoothly, as if K = 4 points of a path were drawn independently. A path that is
something else may lie anywhere: its points are spread evenly over a square as wide as a stroke, L.
With d² the mean squared distance of path and way, both followed evenly along their length,

    log p(path | way)            = −K (d² / 2σ² + log 2πσ²)
    log p(path | something else) = −K log L²

and how likely each hypothesis is follows by Bayes' rule, all being equally likely at first. From
d = σ √(2 log(L² / 2πσ²)) on, 5.0 cm for strokes of 23 cm, something else is likelier than a way.
"""

from collections.abc import Mapping
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver.ways import POINTS, evenly_along, intended_way, stroke_length, way_length
from motionese.task import PrimitiveSequence, Task

SOMETHING_ELSE = "something else"
SPREAD_CM = 2.0
"""σ."""
INDEPENDENT = 4
"""K."""
LONGEST = 6
"""Sequences of at most so many primitives are looked for in a path."""


class _Ways(NamedTuple):
    """Known ways, what they are called, their lengths, and those without the last stroke [m]."""

    names: tuple[str, ...]
    points: Float[ndarray, "S P 3"]
    lengths: Float[ndarray, " S"]
    before: Float[ndarray, " S"]

    def beside(self, own: Mapping[str, Float[ndarray, "_ 3"]]) -> "_Ways":
        """Return these and further ones, by name; they have one stroke."""
        if not own:
            return self
        points = np.array([evenly_along(path) for path in own.values()])
        return _Ways(
            names=(*self.names, *own),
            points=np.concatenate([self.points, points]),
            lengths=np.concatenate([self.lengths, way_length(points)]),
            before=np.concatenate([self.before, np.zeros(len(own))]),
        )


def hypotheses(
    path: Float[ndarray, "T 3"],
    task: Task,
    own: Mapping[str, Float[ndarray, "_ 3"]] | None = None,
    *,
    whole: bool = True,
) -> dict[str, float]:
    """Return how likely a hand's path [m, world] shows each sequence of the task; the sum is 1.

    Args:
        path: The hand's path; times do not matter.
        task: The task.
        own: Further motions by name: paths that were shown for them.
        whole: Whether the path has ended. One that has not is compared with as much of every way,
            and with no way whose last stroke it cannot have begun.

    Returns:
        Shares by name, the likeliest first, and `SOMETHING_ELSE` at its place among them.
    """
    known, seen = _ways(task).beside(own or {}), evenly_along(path)
    length = np.inf if whole else float(way_length(seen))
    begun = known.before <= length
    ways = _cut(known, np.minimum(known.lengths, length))[begun]
    squared = (100 * (ways - seen)) ** 2
    apart = squared.sum(-1).mean(-1) / (2 * SPREAD_CM**2) + np.log(2 * np.pi * SPREAD_CM**2)
    anywhere = 2 * np.log(100 * stroke_length(task))
    likelihood = np.exp(-INDEPENDENT * (np.append(apart, anywhere) - min(*apart, anywhere)))
    names = (*np.array(known.names)[begun].tolist(), SOMETHING_ELSE)
    shares = dict(zip(names, (likelihood / likelihood.sum()).tolist(), strict=True))
    return dict(sorted(shares.items(), key=lambda each: -each[1]))


def sequence_in(path: Float[ndarray, "T 3"], task: Task) -> PrimitiveSequence | None:
    """Return the sequence of the task that a hand's path [m, world] is likeliest, or None."""
    name = next(iter(hypotheses(path, task)))
    return None if name == SOMETHING_ELSE else task.sequence(name)


def _cut(ways: _Ways, lengths: Float[ndarray, " S"]) -> Float[ndarray, "S P 3"]:
    """Return the beginnings of ways, so long each [m], at even distances."""
    at = np.linspace(0.0, (POINTS - 1) * lengths / ways.lengths, POINTS, axis=1)
    low = np.minimum(at.astype(int), POINTS - 2)
    share, each = (at - low)[..., None], np.arange(len(at))[:, None]
    return np.asarray((1 - share) * ways.points[each, low] + share * ways.points[each, low + 1])


@lru_cache(maxsize=4)
def _ways(task: Task) -> _Ways:
    sequences = [s for length in range(1, LONGEST + 1) for s in task.sequences(length)]
    strokes = {s.primitives[0]: way_length(intended_way(s, task)) for s in task.sequences(1)}
    lengths = np.array([sum(strokes[p] for p in s.primitives) for s in sequences])
    return _Ways(
        names=tuple(s.name for s in sequences),
        points=np.array([intended_way(sequence, task) for sequence in sequences]),
        lengths=lengths,
        before=lengths - np.array([strokes[s.primitives[-1]] for s in sequences]),
    )
