"""What a control loop plays: motions one after another."""

from dataclasses import dataclass

from numpy import ndarray

from motionese.errors import ControlError
from motionese.runtime.model import RuntimeModel


@dataclass(frozen=True, eq=False)
class Part:
    """One motion of several.

    Attributes:
        start: The name of a learned motion, or initial states [N].
        steps: How many rows of it are sent; all of the learned motion where left out. Of the first
            part that is one less: its first row is where the robot is already.
        blend: Over how many of these rows the part before passes into this one; with 0 this one
            just sets out from where the one before has come to.
    """

    start: str | ndarray
    steps: int | None = None
    blend: int = 0


def scheduled(model: RuntimeModel, parts: tuple[Part | str, ...]) -> list[tuple[Part, int]]:
    """Return the parts with how many steps each is played; `ControlError` where none can be."""
    if not parts:
        raise ControlError("nothing to play: name a learned motion, or give its initial states")
    given = [Part(part) if isinstance(part, str) else part for part in parts]
    return [(part, _rows_sent(model, part, not i)) for i, part in enumerate(given)]


def _rows_sent(model: RuntimeModel, part: Part, first: bool) -> int:
    model.begin(part.start)
    called, steps = "a motion", part.steps
    if isinstance(part.start, str):
        called = f"motion '{part.start}'"
        if steps is None and part.start in model.lengths:
            steps = model.lengths[part.start] - first
    if steps is None:
        raise ControlError(f"{called}: the model does not tell how long it is; give its steps")
    if steps < 1:
        raise ControlError(f"{called} must be played for 1 step or more, got {steps}")
    if first and part.blend:
        raise ControlError(f"{called} is the first: it has none before it to blend with")
    if not 0 <= part.blend <= steps:
        raise ControlError(f"{called}: its blend must be 0 to its {steps} steps, got {part.blend}")
    return steps
