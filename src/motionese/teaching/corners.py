"""The corners of a motion, where one stroke ends and the next begins, as its pauses tell them.

The robot has no names for strokes while it watches: what parts them for it is a pause (see
`imitation.segments`). A corner is told if the hand pauses within a third of a stroke's length of
it, after it came by the place before and before it comes by the next. Pauses are those that
`motionese.kinematics` finds in the drawing as it went in time, before its stillness is cut to the
scripted caregiver's (see `teaching.drawing`).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import rows_of_places, stroke_length
from motionese.kinematics import Pause
from motionese.task import PrimitiveSequence, Task

NEAR = 1 / 3
"""Share of a stroke's length within which a pause tells a corner."""


class Corner(NamedTuple):
    """A place between two strokes, and whether the hand paused there."""

    place: str
    told: bool


def corners_of(
    sequence: PrimitiveSequence,
    path: Float[ndarray, "R 3"],
    pauses: Sequence[Pause],
    rate_hz: float,
    task: Task,
) -> tuple[Corner, ...]:
    """Return the corners of a sequence in order; none of a single stroke.

    Args:
        sequence: What was shown.
        path: The hand's path in time [m, world].
        pauses: Those measured in it.
        rate_hz: Its rows a second [Hz].
        task: The task.
    """
    places = np.array([task.position(name) for name in sequence.places])
    # Without pauses nothing is looked for: the path may have fewer rows than there are places.
    rows = rows_of_places(path, places) if pauses else ()
    near = NEAR * stroke_length(task)

    def is_told(corner: int) -> bool:
        return any(
            rows[corner - 1] < rate_hz * (pause.start_s + pause.end_s) / 2 < rows[corner + 1]
            and np.linalg.norm(pause.position - places[corner]) <= near
            for pause in pauses
        )

    return tuple(
        Corner(sequence.places[corner], is_told(corner)) for corner in range(1, len(places) - 1)
    )


def pauses_in_words(corners: Sequence[Corner]) -> str:
    """Return where the hand was seen to pause, where it did at every corner; else nothing."""
    if not corners or not all(corner.told for corner in corners):
        return ""
    return f"I saw you pause at {_listed(corners)}."


def wish_in_words(corners: Sequence[Corner]) -> str:
    """Return what is wished of who shows, where a corner was not told; else nothing."""
    missing = [corner for corner in corners if not corner.told]
    if not missing:
        return ""
    where = "corner" if len({corner.place for corner in missing}) == 1 else "corners"
    why = "I could not tell one stroke from the next"
    return f"Pause at the {where} {_listed(missing)}, please: {why}."


def _listed(corners: Sequence[Corner]) -> str:
    """Return the places of corners, each once."""
    *first, last = dict.fromkeys(corner.place for corner in corners)
    return f"{', '.join(first)} and {last}" if first else last
