"""Linear decoders: what the activity of a level tells of the motion that the network is in.

A decoder is a ridge regression from the activity y of one level to what is asked of the same row
(Hoerl & Kennard 1970). With rows x of activity and z of what is asked, both centred, its weights
are (xᵀx + λ1)⁻¹ xᵀz. A class has a column of z to itself, 1 in its rows and 0 elsewhere; the
largest tells. λ is a hundredth of the mean of xᵀx's diagonal, the same for all that is asked of all
levels: it goes with the scale of the activity, and nothing is chosen by the outcome.

Every round of demonstrations (the first of every motion, the second, …) is decoded by what was
fitted to the other rounds. Thus the rows of a demonstration are never on both sides, and every
motion is on both: were single demonstrations left out, their own class would be the rarer one.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.imitation.loop import Row
from motionese.imitation.roles.generated import GeneratedMotion, generated
from motionese.imitation.roles.recognised import RecognisedLesson
from motionese.task import PrimitiveSequence

PENALTY = 0.01
"""λ as a share of the mean scatter of the units."""


class Score(NamedTuple):
    """How well something is decoded, and how well without any activity to decode it from."""

    score: float
    chance: float


def decoded(lesson: RecognisedLesson) -> list[Row]:
    """Decode direction, position and order from every context level while motions are generated.

    - "direction": the sign of the primitive under way. Its score is the share of rows in which it
      is told, chance the share of the most frequent sign.
    - "position": azimuth and elevation of the hand. Its score is R² of both together.
    - "order": which way a motion goes on that shares its `beginning`, one primitive or more, with
      others that go on otherwise. Every `row` is decoded by itself, and counted from the one in
      which the ways part: those before are negative. Score and chance are shares of demonstrations.

    Returns:
        A row for each level and what is asked of it. There is none where nothing can be decoded:
        from constant activity, of a single class, or of one that a single round has.
    """
    motions, network = generated(lesson), lesson.network
    rounds = [m.number for m in motions]
    rows: list[Row] = []
    for level in network.names[1:]:
        own = network.units(level)
        inside = [m.activity[:, own] for m in motions]
        whole = {
            "direction": class_score(inside, [m.signs for m in motions], rounds),
            "position": value_score(inside, [m.seen for m in motions], rounds),
        }
        told = [{"what": what, **score._asdict()} for what, score in whole.items() if score]
        told += [{"what": "order", **row} for row in _orders(motions, own)]
        rows += [{"level": level, **row} for row in told]
    return rows


def class_score(
    activity: Sequence[Float[ndarray, "_ n"]],
    labels: Sequence[Sequence[str]],
    rounds: Sequence[int],
) -> Score | None:
    """Return in which share of all rows their class is told; None where nothing can be decoded.

    Args:
        activity: What is decoded from, by demonstration. [T, n] each
        labels: The class of every row.
        rounds: The round that each demonstration belongs to.
    """
    rounds_of: dict[str, set[int]] = {}
    for own, number in zip(labels, rounds, strict=True):
        for name in own:
            rounds_of.setdefault(name, set()).add(number)
    if any(len(numbers) < 2 for numbers in rounds_of.values()):
        return None
    names = sorted(rounds_of)
    targets = [np.array([[float(name == n) for n in names] for name in own]) for own in labels]
    found = _cross_validated(activity, targets, rounds)
    if found is None:
        return None
    told, true, _ = found
    right = told.argmax(axis=1) == true.argmax(axis=1)
    return Score(float(right.mean()), float(true.mean(axis=0).max()))


def value_score(
    activity: Sequence[Float[ndarray, "_ n"]],
    values: Sequence[Float[ndarray, "_ k"]],
    rounds: Sequence[int],
) -> Score | None:
    """Return R² of values of one unit; 0 is that of the mean of the rows that were fitted to.

    Arguments are as in `class_score`, with values in the place of labels. [T, k] each
    """
    found = _cross_validated(activity, values, rounds)
    if found is None:
        return None
    told, true, mean = found
    return Score(float(1 - ((told - true) ** 2).sum() / ((mean - true) ** 2).sum()), 0.0)


def ridge(
    x: Float[ndarray, "R n"], z: Float[ndarray, "R k"]
) -> Callable[[Float[ndarray, "S n"]], Float[ndarray, "S k"]]:
    """Fit what is asked, z, to activity, x, which must not be constant; return what it tells."""
    centre, mean = x.mean(axis=0), z.mean(axis=0)
    scatter = (x - centre).T @ (x - centre)
    penalty = PENALTY * scatter.diagonal().mean() * np.eye(len(scatter))
    weights = np.linalg.solve(scatter + penalty, (x - centre).T @ (z - mean))
    return lambda rows: mean + (rows - centre) @ weights


def _cross_validated(
    activity: Sequence[ndarray], targets: Sequence[ndarray], rounds: Sequence[int]
) -> tuple[ndarray, ndarray, ndarray] | None:
    """Return, of all rows, what is told, what is true, and the mean that was fitted to. [R, k]"""
    if len(set(rounds)) < 2:
        return None
    parts = []
    for held_out in sorted(set(rounds)):
        own = [i for i, number in enumerate(rounds) if number == held_out]
        rest = [i for i, number in enumerate(rounds) if number != held_out]
        x, z = (np.concatenate([each[i] for i in rest]) for each in (activity, targets))
        if not (np.ptp(x, axis=0).any() and np.ptp(z, axis=0).any()):
            return None
        shown, true = (np.concatenate([each[i] for i in own]) for each in (activity, targets))
        parts.append((ridge(x, z)(shown), true, np.broadcast_to(z.mean(axis=0), true.shape)))
    told, true, mean = (np.concatenate(each) for each in zip(*parts, strict=True))
    return told, true, mean


def _orders(motions: Sequence[GeneratedMotion], units: slice) -> Iterator[Row]:
    """Yield how well the way on is told, by beginning and row."""
    by_beginning: dict[PrimitiveSequence, list[tuple[GeneratedMotion, int]]] = {}
    for motion in motions:
        for done in range(1, len(motion.begins)):
            beginning = PrimitiveSequence(motion.sequence.primitives[:done])
            by_beginning.setdefault(beginning, []).append((motion, motion.begins[done]))
    for beginning, shared in by_beginning.items():
        done = len(beginning.primitives)
        left = min(len(m.activity) - parting for m, parting in shared)
        for row in range(-min(parting for _, parting in shared), left):
            score = class_score(
                [m.activity[parting + row, units][None] for m, parting in shared],
                [[m.sequence.primitives[done].name] for m, _ in shared],
                [m.number for m, _ in shared],
            )
            if score:
                yield {"beginning": beginning.name, "row": row, **score._asdict()}
