"""The verdict on a demonstration: the motion that was understood, and how sure that is.

A candidate is a hypothesis about both what was shown and what was understood of it. With d its
distance from either path [cm] and σ = 2 cm, the spread of a person's hand about the ways between
the places, its log likelihood is −(d_shown² + d_understood²) / 2σ², and its confidence the softmax
of these over all candidates: known motions, all sequences of up to three primitives, and what was
read from both paths. A network that understood something else than was shown is far from every
candidate in one of the two, so that none is sure.

Distances compare ways, not times: both paths are followed evenly along their length.
"""

from collections.abc import Collection, Iterable
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import evenly_along, intended_way, sequence_in
from motionese.errors import TaskError
from motionese.imitation import path_error_cm
from motionese.task import PrimitiveSequence, Task
from motionese.teaching.recogniser import start_of

SPREAD_CM = 2.0
"""σ."""
SURE, LIKELY = 0.8, 0.4
ALTERNATIVES = 3


@dataclass(frozen=True)
class Verdict:
    """What the robot says of a demonstration.

    Attributes:
        recognised: What it understood; None if that is no sequence of the task.
        shown: What was drawn, read without the network; None if that is no sequence of the task.
        confidence: Of `recognised`, from 0 to 1.
        alternatives: Other candidates with their confidence, the likeliest first.
        error_cm: Mean distance of the understood path from the shown one, row by row [cm].
        sentence: All this in words.
    """

    recognised: PrimitiveSequence | None
    shown: PrimitiveSequence | None
    confidence: float
    alternatives: tuple[tuple[PrimitiveSequence, float], ...]
    error_cm: float
    sentence: str


def verdict_on(
    shown: Float[ndarray, "T 3"],
    understood: Float[ndarray, "T 3"],
    task: Task,
    known: Iterable[str],
) -> Verdict:
    """Return the verdict on a shown and an understood path [m, world]; `known` names motions."""
    recognised, drawn = (sequence_in(path, task) for path in (understood, shown))
    candidates = _candidates(known, (recognised, drawn), task)
    sure = dict(zip(candidates, confidence(candidates, shown, understood, task), strict=True))
    others = sorted((c for c in candidates if c != recognised), key=lambda c: -sure[c])
    how_sure = sure[recognised] if recognised else 0.0
    return Verdict(
        recognised=recognised,
        shown=drawn,
        confidence=how_sure,
        alternatives=tuple((other, sure[other]) for other in others[:ALTERNATIVES]),
        error_cm=path_error_cm(understood, shown),
        sentence=_sentence(task, shown, recognised, drawn, how_sure),
    )


def confidence(
    candidates: Collection[PrimitiveSequence],
    shown: Float[ndarray, "T 3"],
    understood: Float[ndarray, "T 3"],
    task: Task,
) -> list[float]:
    """Return how likely each candidate is (see the module), given paths of the hand [m]."""
    ways = np.array([intended_way(sequence, task) for sequence in candidates])
    logarithms = np.zeros(len(candidates))
    for path in (shown, understood):
        apart = 100 * np.linalg.norm(ways - evenly_along(path), axis=-1).mean(-1)
        logarithms -= (apart / SPREAD_CM) ** 2 / 2
    shares = np.exp(logarithms - logarithms.max())
    return [float(share) for share in shares / shares.sum()]


def _candidates(
    known: Iterable[str], read: Iterable[PrimitiveSequence | None], task: Task
) -> list[PrimitiveSequence]:
    sequences = [s for length in (1, 2, 3) for s in task.sequences(length)]
    for name in known:
        with suppress(TaskError):  # babbling, and what a person taught that is no sequence
            sequences.append(task.sequence(name))
    return list(dict.fromkeys([*sequences, *filter(None, read)]))


def _sentence(
    task: Task,
    path: Float[ndarray, "T 3"],
    recognised: PrimitiveSequence | None,
    shown: PrimitiveSequence | None,
    sure: float,
) -> str:
    if recognised is None:
        start = task.places[start_of(path, task).start].title
        return f"I saw your hand begin at {start}, but I do not know this motion yet."
    said = task.in_words(recognised)
    if sure > SURE:
        return f"I understood: {said}."
    if sure > LIKELY:
        return f"I think it was {said}."
    if shown is not None and shown != recognised:
        return f"It looked like {said} to me, but that does not fit what I saw."
    return f"Was it {said}? I am not sure."
