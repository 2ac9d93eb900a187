"""Practice of a robot that a person teaches: training on the experience that it remembers."""

from collections.abc import Callable

from motionese.errors import MotioneseError
from motionese.imitation import BABBLING, Learner, Scene, key_for
from motionese.learning import Progress

CAPACITY, STROKES = 12, 3
"""Experiences, and strokes each, that training is compiled for; twice as many where needed."""

Report = Callable[[int, int, Progress], None]
"""Called while the network learns, with epochs done, epochs in all, and how good it is by now."""


class DivergedError(MotioneseError):
    """Training left weights that are no numbers; nothing was learned."""


def practised(
    scene: Scene, learner: Learner, loop: int, report: Report, part: tuple[int, int] = (0, 1)
) -> Learner:
    """Return what a robot becomes by training.

    A person shows one motion at a time: beside the experience of the last loops, of each motion
    at least the latest is remembered.

    Args:
        learner: What the robot is, its new experience included.
        loop: The loop that the new experience carries.
        report: Called while it learns; what it raises ends the training.
        part: Which of how many trainings in a row this is, for `report`.

    Raises:
        DivergedError: The loss or a weight was no longer finite.
    """
    settings = scene.settings
    names = {e.motion for e in learner.experiences} - {BABBLING}
    learner = learner.remembering(loop, settings.imitation.memory, names)
    longest = max(len(e.values) for e in learner.experiences)
    epochs, (done, parts) = settings.training.epochs, part
    many = _doubled(CAPACITY, len(learner.experiences))
    rows = _doubled(STROKES * settings.caregiver.primitive_rows, longest)
    learner, fit = learner.trained(
        settings.training,
        scene.body.rate_hz,
        key=key_for(scene.seed, "training", loop),
        padded_to=(many, rows),
        progress=lambda now: report(done * epochs + now.epoch, parts * epochs, now),
    )
    if fit.status.failed:
        raise DivergedError(f"I could not learn this ({fit.status.sentence}); I am as I was before")
    return learner


def _doubled(size: int, least: int) -> int:
    """Return a size, doubled until it is large enough."""
    while size < least:
        size *= 2
    return size
