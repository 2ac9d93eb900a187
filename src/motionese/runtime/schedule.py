"""What a control loop plays: motions one after another, and how long it takes between them."""

from dataclasses import dataclass, replace
from functools import partial
from numbers import Integral

import numpy as np
from numpy import ndarray

from motionese.errors import ControlError
from motionese.minimum_jerk import transition_rows
from motionese.runtime.model import RuntimeModel
from motionese.runtime.player import Blend, Player


@dataclass(frozen=True, eq=False)
class Part:
    """One motion of several.

    Attributes:
        start: The name or place of a learned motion, or initial states [N].
        steps: How many rows of it are sent; all of the learned motion where left out. Of the first
            part that is one less: its first row is where the robot is already.
        blend: Over how many of these rows the part before, or standing still before the first one,
            passes into this one. Where left out, as many as it needs to be about as fast as the
            motions themselves, up to half of this one. With 0 this one just sets out from where
            the robot has come to, and may rush to its own way.
    """

    start: str | int | ndarray
    steps: int | None = None
    blend: int | None = None


@dataclass(frozen=True, eq=False)
class ScheduledPart:
    """A part as it will be played: so many steps, and how the part before passes into it."""

    start: str | int | ndarray
    steps: int
    blend: Blend


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


def schedule(model: RuntimeModel, parts: tuple[Part | str | int, ...]) -> list[ScheduledPart]:
    """Return the parts as they will be played; `ControlError` where one cannot be."""
    if not parts:
        raise ControlError("nothing to play: name a learned motion, or give its initial states")
    given = [_named(model, part) for part in parts]
    steps = [_rows_sent(model, part, not i) for i, part in enumerate(given)]
    blends: list[Blend] = [part.blend or 0 for part in given]
    if any(part.blend is None for part in given):
        # Before the robot moves: inside a cycle there is no time for it.
        rows = [steps[0] + 1, *steps[1:]]
        courses = [course(model, p.start, n) for p, n in zip(given, rows, strict=True)]
        for i, part in enumerate(given):
            if part.blend is None:
                blends[i] = partial(rows_between, courses[max(i - 1, 0)], courses[i])
    return [ScheduledPart(p.start, n, b) for p, n, b in zip(given, steps, blends, strict=True)]


def _named(model: RuntimeModel, given: Part | str | int) -> Part:
    """Return a part whose learned motion, if it is one, is told by its name."""
    part = given if isinstance(given, Part) else Part(given)
    if isinstance(part.start, str | int | np.integer):
        return replace(part, start=model.named(part.start))
    return part


def course(model: RuntimeModel, start: str | int | ndarray, rows: int) -> Course:
    """Play a motion of so many rows by itself; about 15 µs a row."""
    player, nothing = Player(model, model.begin(start)), np.full(len(model.channels), np.nan)
    way = np.array([player.row, *(player.step_unit(nothing) for _ in range(rows - 1))])
    return Course(way[0], np.abs(np.diff(way, axis=0)).max(axis=0, initial=0.0), rows)


def rows_between(former: Course, latter: Course, here: ndarray) -> int:
    """Return how many rows a transition takes from here [D], at most half of the later motion's.

    It takes so many, too, where a channel stands still in both motions, at different places. It is
    as long as the library's `generate_sequence` makes it.
    """
    speed = np.maximum(former.speed, latter.speed)
    return transition_rows(np.abs(latter.first - here), speed, latter.rows // 2)


def _rows_sent(model: RuntimeModel, part: Part, first: bool) -> int:
    model.begin(part.start)
    called, steps = "a motion", part.steps
    if isinstance(part.start, str):
        called = f"motion '{part.start}'"
        if steps is None and part.start in model.lengths:
            steps = model.lengths[part.start] - first
    if steps is None:
        raise ControlError(f"{called}: the model does not tell how long it is; give its steps")
    if not isinstance(steps, Integral) or steps < 1:
        raise ControlError(
            f"{called} must be played for a whole number of steps, 1 or more, got {steps}"
        )
    blend = part.blend
    if blend is not None and not (isinstance(blend, Integral) and 0 <= blend <= steps):
        raise ControlError(f"{called}: its blend must be 0 to its {steps} steps, got {blend}")
    return steps
