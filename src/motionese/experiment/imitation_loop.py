"""One imitation loop, in the five steps of the paper's section IV-A.

1. Show: the caregiver shows every motion of the lesson; the robot's eye follows the hand.
2. Recognise: the initial states of each motion are found from neck and hand channels alone.
3. Perform: the network generates each motion from them, and the body executes it.
4. Train: the network learns from what the own body did.
5. Again, from 1, with new demonstrations.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.caregiver import Motion
from motionese.experiment.keys import key_for
from motionese.experiment.learner import Experience, Learner
from motionese.experiment.measures import path_error_cm, press_depths_mm, pressed, seen_error_cm
from motionese.experiment.perform import ARM, Performance, Watched
from motionese.experiment.scene import Scene
from motionese.learning import (
    Found,
    Motions,
    Recognition,
    Status,
    Training,
    generate,
    recognise_all,
    train,
)

S = TypeVar("S", Training, Recognition)
Row = dict[str, Any]
"""One line of a table, by column."""


@dataclass(frozen=True)
class Imitated:
    """A motion as it was shown, understood and performed."""

    motion: Motion
    watched: Watched
    found: Found
    performance: Performance

    def measures(self, scene: Scene) -> Row:
        """Return the errors [cm] and the presses of this imitation."""
        depths = press_depths_mm(self.motion, self.performance.depths, scene.settings.caregiver)
        shown, done = self.watched, self.performance
        return {
            "imitation_error_cm": path_error_cm(done.path, shown.path),
            "recognition_residual_cm": seen_error_cm(self.found.path, shown.sensed, shown.path),
            "model_error_cm": seen_error_cm(done.sensed, done.predicted, done.path),
            "buttons_due": len(depths),
            "buttons_pressed": pressed(depths),
            "press_depth_mm": float(np.mean(depths)) if depths else np.nan,
            "press_depths_mm": " ".join(f"{depth:.2f}" for depth in depths),
        }


def imitate(
    scene: Scene,
    learner: Learner,
    motions: Sequence[Motion],
    settings: Recognition,
    *occasion: str | int,
) -> list[Imitated]:
    """Take steps 1 to 3 with some motions; nothing is learned."""
    network = learner.network
    watched = [scene.show(motion, *occasion) for motion in motions]  # step 1
    values = [scene.as_own(m, w) for m, w in zip(motions, watched, strict=True)]
    seen = shown_as(scene, values, names=[m.name for m in motions])
    starts = np.array([learner.start_for(motion) for motion in motions])[:, None]
    found = recognise_all(  # step 2
        network,
        seen,
        starts=starts,
        settings=for_levels(settings, learner),
        key=key_for(scene.seed, "recognition", *occasion),
    )
    performed = [  # step 3
        scene.perform(network, f.initial_state, motion, len(value), *occasion)
        for motion, f, value in zip(motions, found, values, strict=True)
    ]
    return [Imitated(*each) for each in zip(motions, watched, found, performed, strict=True)]


def shown_as(
    scene: Scene,
    values: Sequence[Float[ndarray, "_ 6"]],
    *,
    own_arm: bool = True,
    names: Sequence[str] | None = None,
) -> Motions:
    """Return what is recognised of demonstrations: neck and hand, and of the arm the first row.

    Args:
        scene: Robot and caregiver.
        values: The channels' values of every demonstration.
        own_arm: Whether the first row's arm is where the own one will start from; if not, as
            when a demonstration is looked at from its middle on, the arm is not known at all.
        names: The demonstrations' names.
    """
    masks = [np.ones(value.shape, dtype=bool) for value in values]
    for mask in masks:
        mask[int(own_arm) :, ARM] = False
    return Motions.from_arrays(
        values, scene.body.channels, scene.body.rate_hz, observed=masks, names=names
    )


def imitation_loop(
    scene: Scene, learner: Learner, lesson: Sequence[Motion], loop: int, capacity: int
) -> tuple[Learner, list[Row], Row, Status]:
    """Take steps 1 to 4 once.

    Args:
        scene: Robot and caregiver.
        learner: What the robot is before the loop.
        lesson: The motions that are taught.
        loop: The loop's number, from 1.
        capacity: Experiences that training is compiled for, at least as many as are remembered.

    Returns:
        What the robot is after it; a row per motion; a row on the network; how training ended.
    """
    began = time.perf_counter()
    settings, channels = scene.settings, scene.body.channels
    imitated = imitate(scene, learner, lesson, settings.recognition, "loop", loop)
    fresh = tuple(
        Experience(
            loop,
            each.motion.name,
            each.performance.experience(settings.imitation.efference_copy),
            each.found.initial_state,
        )
        for each in imitated
    )
    learner = replace(learner, experiences=(*learner.experiences, *fresh))
    learner = learner.remembering(loop, settings.imitation.memory, rehearsed_motions(scene))
    motions = learner.motions(channels, scene.body.rate_hz)
    fit = train(  # step 4
        learner.network,
        motions,
        settings=for_levels(settings.training, learner),
        initial_states=np.array([e.initial_state for e in learner.experiences]),
        key=key_for(scene.seed, "training", loop),
        padded_to=(max(capacity, len(motions)), max(motions.lengths)),
    )
    learner = Learner(
        fit.network,
        tuple(
            replace(e, initial_state=state)
            for e, state in zip(learner.experiences, fit.initial_states, strict=True)
        ),
    )
    errors = _reproduction_errors(learner, imitated, loop)
    seconds = (time.perf_counter() - began) / len(imitated)
    rows = [
        {
            "loop": loop,
            "motion": each.motion.name,
            **each.measures(scene),
            "reproduction_error_cm": error,
            "status": str((fit.status if fit.status.failed else each.found.status).ending.value),
            "seconds": seconds,
        }
        for each, error in zip(imitated, errors, strict=True)
    ]
    return learner, rows, {"loop": loop, **development(learner), "loss": fit.losses[-1]}, fit.status


def _reproduction_errors(learner: Learner, imitated: list[Imitated], loop: int) -> list[float]:
    """Return how far [cm] the trained network's motions are from this loop's experience."""
    states = {e.motion: e for e in learner.experiences if e.loop == loop}
    errors = []
    for each in imitated:
        experience = states[each.motion.name]
        path = generate(
            learner.network,
            experience.initial_state,
            len(experience.values),
            first=experience.values[0],
        )
        errors.append(seen_error_cm(path, experience.values, each.performance.path))
    return errors


def rehearsed_motions(scene: Scene) -> frozenset[str]:
    """Return the motions whose latest experience is never forgotten: those of all first phases."""
    if not scene.settings.imitation.rehearsal:
        return frozenset()
    teachings = scene.settings.teaching
    return frozenset(m.name for t in teachings for m in scene.settings.lessons(t)[0])


def development(learner: Learner) -> Row:
    """Return what the network has become: its levels, largest initial states, slow weights."""
    network = learner.network
    row: Row = {"levels": len(network.levels)}
    for level in network.levels[1:]:
        states = [e.initial_state[network.units(level.name)] for e in learner.experiences]
        row[f"largest_{level.name}_0"] = float(np.abs(states).max()) if states else np.nan
    for below, above in zip(network.levels[1:], network.levels[2:], strict=False):
        block = network.weights[network.units(below.name), network.units(above.name)]
        row[f"rms_{above.name}_to_{below.name}"] = float(np.sqrt((np.asarray(block) ** 2).mean()))
    return row


def for_levels(settings: S, learner: Learner) -> S:
    """Return settings without bounds and noise of levels that are not open yet."""
    names = {level.name for level in learner.network.levels}
    limited = {
        field: {level: value for level, value in by_level.items() if level in names}
        for field in ("bound", "noise")
        if isinstance(by_level := getattr(settings, field, None), dict)
    }
    return settings.model_copy(update=limited)
