"""Training of a robot that a person teaches, on the experience that it remembers."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from motionese.errors import MotioneseError
from motionese.experiment import Learner, Scene
from motionese.experiment.imitation_loop import for_levels
from motionese.experiment.keys import key_for
from motionese.experiment.learner import BABBLING
from motionese.learning import Progress, train

CAPACITY, STROKES = 12, 3
"""Experiences, and strokes each, that training is compiled for; twice as many where needed."""

Told = Callable[[int, int, Progress], None]
"""Called while the network learns, with epochs done, epochs in all, and how good it is by now."""


class DivergedError(MotioneseError):
    """Training left weights that are no numbers; nothing was learned."""


def trained(
    scene: Scene, learner: Learner, loop: int, told: Told, part: tuple[int, int] = (0, 1)
) -> Learner:
    """Return what a robot becomes by training.

    A person shows one motion at a time: beside the experience of the last loops, of each motion
    at least the latest is remembered.

    Args:
        scene: Robot and settings.
        learner: What the robot is, its new experience included.
        loop: The loop that the new experience carries.
        told: Called while it learns; what it raises ends the training.
        part: Which of how many trainings in a row this is, for `told`.

    Raises:
        DivergedError: The loss or a weight was no longer finite.
    """
    settings = scene.settings
    names = {e.motion for e in learner.experiences} - {BABBLING}
    learner = learner.remembering(loop, settings.imitation.memory, names)
    motions = learner.motions(scene.body.channels, scene.body.rate_hz)
    primitive = settings.caregiver.stroke_steps + settings.caregiver.rest_steps
    epochs, (done, parts) = settings.training.epochs, part
    fit = train(
        learner.network,
        motions,
        settings=for_levels(settings.training, learner),
        initial_states=np.array([e.initial_state for e in learner.experiences]),
        key=key_for(scene.seed, "training", loop),
        padded_to=(
            _doubled(CAPACITY, len(motions)),
            _doubled(STROKES * primitive, max(motions.lengths)),
        ),
        progress=lambda now: told(done * epochs + now.epoch, parts * epochs, now),
    )
    if fit.status.failed:
        raise DivergedError(f"I could not learn this ({fit.status.sentence}); I am as I was before")
    pairs = zip(learner.experiences, fit.initial_states, strict=True)
    return Learner(fit.network, tuple(replace(e, initial_state=s) for e, s in pairs))


def _doubled(size: int, least: int) -> int:
    """Return a size, doubled until it is large enough."""
    while size < least:
        size *= 2
    return size
