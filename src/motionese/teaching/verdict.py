"""The verdict on a demonstration: the motion that was understood, and how sure that is.

A candidate motion is a hypothesis about both what was shown and what was understood of it. With d
its distance from either path [cm] and σ = 2 cm, the spread of a person's hand about the straight
strokes between the corners, its log likelihood is −(d_shown² + d_understood²) / 2σ², and its
confidence the softmax of these over all candidates: known motions, all motions of up to three
primitives, and what was read from both paths. A network that understood something else than was
shown is far from every candidate in one of the two, so that none is sure.

Distances compare ways, not times: both paths are followed evenly along their length.
"""

from collections.abc import Collection, Iterable
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import PUSHING_BUTTONS, Demonstrating, Motion
from motionese.errors import TaskError
from motionese.experiment.perform import Watched
from motionese.teaching.reading import (
    PLACES,
    Corners,
    corners_of,
    in_words,
    motion_read,
    nearest_corner,
)
from motionese.teaching.recognising import Understood

SPREAD_CM = 2.0
"""σ."""
SURE, LIKELY = 0.8, 0.4
POINTS = 64
ALTERNATIVES = 3


@dataclass(frozen=True)
class Verdict:
    """What the robot says of a demonstration.

    Attributes:
        motion: What it understood; None if that is no motion of the task.
        shown: What was drawn, read without the network; None if that is no motion of the task.
        confidence: Of `motion`, from 0 to 1.
        alternatives: Other candidates with their confidence, the likeliest first.
        error_cm: Mean distance of the understood path from the shown one, row by row [cm].
        sentence: All this in words.
    """

    motion: Motion | None
    shown: Motion | None
    confidence: float
    alternatives: tuple[tuple[Motion, float], ...]
    error_cm: float
    sentence: str


def judged(
    watched: Watched, understood: Understood, manner: Demonstrating, known: Iterable[str]
) -> Verdict:
    """Return the verdict on what was watched.

    Args:
        watched: The demonstration.
        understood: What recognition made of it.
        manner: Where the corners are.
        known: Names of the motions that were learned.
    """
    corners = corners_of(manner)
    motion, shown = (motion_read(path, corners) for path in (understood.path, watched.path))
    candidates = _candidates(known, (motion, shown))
    confidences = confidence(candidates, watched.path, understood.path, corners)
    by_motion = dict(zip(candidates, confidences, strict=True))
    others = sorted((c for c in candidates if c != motion), key=lambda c: -by_motion[c])
    sure = by_motion[motion] if motion else 0.0
    error = float(100 * np.linalg.norm(understood.path - watched.path, axis=1).mean())
    return Verdict(
        motion=motion,
        shown=shown,
        confidence=sure,
        alternatives=tuple((other, by_motion[other]) for other in others[:ALTERNATIVES]),
        error_cm=error,
        sentence=_sentence(motion, shown, sure, nearest_corner(watched.path[0], corners)),
    )


def confidence(
    candidates: Collection[Motion],
    shown: Float[ndarray, "T 3"],
    understood: Float[ndarray, "T 3"],
    corners: Corners,
) -> list[float]:
    """Return how likely each candidate is (see the module), given paths of the hand [m]."""
    logarithms = np.zeros(len(candidates))
    for path in (shown, understood):
        way = _along(path)
        ways = [_along(np.array([corners[c] for c in motion.corners])) for motion in candidates]
        apart = 100 * np.linalg.norm(np.array(ways) - way, axis=-1).mean(-1)
        logarithms -= (apart / SPREAD_CM) ** 2 / 2
    shares = np.exp(logarithms - logarithms.max())
    return [float(share) for share in shares / shares.sum()]


def _candidates(known: Iterable[str], read: Iterable[Motion | None]) -> list[Motion]:
    motions = [m for length in (1, 2, 3) for m in PUSHING_BUTTONS.sequences(length)]
    for name in known:
        try:
            motions.append(PUSHING_BUTTONS.motion(name))
        except TaskError:  # babbling, and what a person taught that is no motion of the task
            continue
    return list(dict.fromkeys([*motions, *(motion for motion in read if motion)]))


def _along(path: Float[ndarray, "R 3"]) -> Float[ndarray, "P 3"]:
    """Return points at even distances along a path."""
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(steps)])
    places = np.linspace(0.0, length[-1], POINTS)
    return np.stack([np.interp(places, length, column) for column in path.T], axis=-1)


def _sentence(motion: Motion | None, shown: Motion | None, sure: float, start: str) -> str:
    if motion is None:
        return f"I saw your hand begin at {PLACES[start]}, but I do not know this motion yet."
    said = in_words(motion)
    if sure > SURE:
        return f"I understood: {said}."
    if sure > LIKELY:
        return f"I think it was {said}."
    if shown is not None and shown != motion:
        return f"It looked like {said} to me, but that does not fit what I saw."
    return f"Was it {said}? I am not sure."
