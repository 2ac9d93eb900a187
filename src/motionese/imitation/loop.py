"""One imitation loop, in the five steps of the paper's section IV-A.

1. Show: the caregiver shows every sequence of the lesson; the robot's eye follows the hand.
2. Recognise: the initial state of each is found from what is seen of the hand alone.
3. Perform: the network generates each motion from it, and the body executes it.
4. Train: the network learns from what the own body did.
5. Again, from 1, with new demonstrations.
"""

import time
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from motionese.caregiver import Manner
from motionese.imitation.attention import attention
from motionese.imitation.development import Stage
from motionese.imitation.keys import key_for
from motionese.imitation.learner import Learner, Nearest
from motionese.imitation.measures import path_error_cm, seen_error_cm
from motionese.imitation.performance import Performance, Watched
from motionese.imitation.repertoire import element_seen, element_to_a_pause
from motionese.imitation.scene import Scene
from motionese.imitation.segments import strokes_seen
from motionese.learning import Recognition, RecognitionResult, Status, generate, recognise_all
from motionese.task import Attempt, PrimitiveSequence

Row = dict[str, Any]
"""One line of a table, by column."""


@dataclass(frozen=True)
class Imitation:
    """A sequence as it was shown, understood and performed."""

    sequence: PrimitiveSequence
    watched: Watched
    found: RecognitionResult
    performance: Performance

    def measures(self, scene: Scene) -> Row:
        """Return the errors [cm] of this imitation, and what the task says it has achieved."""
        shown, done, body = self.watched, self.performance, scene.body
        attempt = Attempt(shown.begins, shown.path, done.path, done.effects)
        return {
            "imitation_error_cm": path_error_cm(done.path, shown.path),
            "recognition_residual_cm": seen_error_cm(
                body, self.found.path, shown.sensed, shown.path
            ),
            "model_error_cm": seen_error_cm(body, done.sensed, done.predicted, done.path),
            **scene.task.achieved(self.sequence, attempt),
        }


def imitate(
    scene: Scene,
    learner: Learner,
    sequences: Sequence[PrimitiveSequence],
    settings: Recognition,
    *occasion: str | int,
    manner: Manner | None = None,
) -> list[Imitation]:
    """Take steps 1 to 3 with some sequences; nothing is learned.

    Recognition starts from what is nearest in the repertoire to what was seen.
    """
    watched = [scene.show(s, *occasion, manner=manner) for s in sequences]  # step 1
    values = [scene.as_own(s.start, w) for s, w in zip(sequences, watched, strict=True)]
    found = recognise_all(  # step 2
        (learner.network, learner.memory),
        scene.to_recognise(values, names=[s.name for s in sequences]),
        settings=learner.for_levels(settings),
        key=key_for(scene.seed, "recognition", *occasion),
    )
    performed = [  # step 3
        scene.perform(learner.network, f.initial_state, sequence, len(value), *occasion)
        for sequence, f, value in zip(sequences, found, values, strict=True)
    ]
    return [Imitation(*each) for each in zip(sequences, watched, found, performed, strict=True)]


def imitation_loop(
    scene: Scene,
    learner: Learner,
    stage: Stage,
    loop: int,
    capacity: int,
    rehearsed: Collection[str] = (),
) -> tuple[Learner, list[Row], Row, Status]:
    """Take steps 1 to 4 once.

    Args:
        scene: Robot and caregiver.
        learner: What the robot is before the loop.
        stage: What is taught, and how.
        loop: The loop's number, from 1.
        capacity: Experiences that training is compiled for, at least as many as are remembered.
        rehearsed: Motions whose latest experience is never forgotten.

    Returns:
        What the robot is after it; a row per sequence; a row on the network; how training ended.
    """
    began = time.perf_counter()
    settings, rate_hz = scene.settings, scene.body.rate_hz
    imitated = imitate(
        scene, learner, stage.lesson, settings.recognition, "loop", loop, manner=stage.manner
    )
    grouping = settings.training.grouping
    nearest = element_seen if grouping == "seen" else _up_to_a_pause(scene)
    for each in imitated:
        values = each.performance.experience(settings.imitation.efference_copy)
        name, state = each.sequence.name, each.found.initial_state
        seen = None if grouping == "labels" else scene.seen(each.watched)
        begins_with = learner.begins_with(name, seen, nearest)
        begins = each.watched.begins
        learner = learner.experiencing(loop, name, values, state, begins_with, begins)
    learner = learner.remembering(loop, settings.imitation.memory, rehearsed)
    learner, fit = learner.trained(  # step 4
        settings.training,
        rate_hz,
        key=key_for(scene.seed, "training", loop),
        padded_to=(capacity, 0),
        weigh=attention(scene.body, settings),
    )
    recalled = _recalled(scene, learner, imitated, loop)
    seconds = (time.perf_counter() - began) / len(imitated)
    rows = [
        {
            "loop": loop,
            "motion": each.sequence.name,
            **each.measures(scene),
            **recall,
            "status": str((fit.status if fit.status.failed else each.found.status).ending.value),
            "seconds": seconds,
        }
        for each, recall in zip(imitated, recalled, strict=True)
    ]
    return learner, rows, {"loop": loop, **network_row(learner), "loss": fit.losses[-1]}, fit.status


def _up_to_a_pause(scene: Scene) -> Nearest:
    """Return how the nearest element is found where the seen hand's pauses divide what is shown."""
    bearing, rate_hz = scene.body.bearing, scene.body.rate_hz
    return partial(element_to_a_pause, strokes=lambda v: strokes_seen(bearing(v), rate_hz))


def _recalled(scene: Scene, learner: Learner, imitated: list[Imitation], loop: int) -> list[Row]:
    """Return how far [cm] what the trained network recalls is from this loop's experience.

    It recalls a motion from the initial states that it has learned: as a whole, stroke by stroke,
    and what it takes the motion to begin with, by the level whose repertoire that is of.
    """
    fresh = {e.motion: e for e in learner.experiences if e.loop == loop}
    rows = []
    for each in imitated:
        own, hand = fresh[each.sequence.name], each.performance.path
        path = generate(learner.network, own.initial_state, len(own.values), first=own.values[0])
        ends = (*each.watched.begins[1:], len(path))
        strokes = [
            seen_error_cm(scene.body, path[a:b], own.values[a:b], hand[a:b])
            for a, b in zip(each.watched.begins, ends, strict=True)
        ]
        rows.append(
            {
                "reproduction_error_cm": seen_error_cm(scene.body, path, own.values, hand),
                "reproduction_strokes_cm": " ".join(f"{error:.2f}" for error in strokes),
                **{f"begins_with_{level}": name for level, name in own.begins_with.items()},
            }
        )
    return rows


def network_row(learner: Learner) -> Row:
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
