"""Imitation while watching: the robot follows a demonstration at a lag of some rows.

It recognises what it sees reading by reading (`recognise_online`) and commands, for every row, the
joints that the present recognition gives that row, so many rows later than it was shown. What it
sees is what `watch` saw; the caregiver's hand and its own never meet.
"""

from collections.abc import Sequence

import numpy as np

from motionese.imitation.keys import generator_for
from motionese.imitation.learner import Learner
from motionese.imitation.loop import Imitation, Row
from motionese.imitation.measures import path_error_cm
from motionese.imitation.performance import Performance, Trial, Watched
from motionese.imitation.scene import Scene
from motionese.learning import recognise_online
from motionese.runtime import OnlineResult
from motionese.task import PrimitiveSequence


def recognised_while_shown(
    scene: Scene, learner: Learner, start: str, watched: Watched
) -> list[OnlineResult]:
    """Return what the robot knows after every row of a demonstration that begins in a place."""
    settings = scene.settings.evaluation.online
    fit = learner.as_fit(scene.body.rate_hz)
    online = recognise_online(fit, window=settings.window, steps=settings.steps, ahead=1)
    values = scene.as_own(start, watched)
    values[1:, scene.joints] = np.nan
    return [online.observe(row) for row in values]


def follow(
    scene: Scene,
    sequence: PrimitiveSequence,
    results: Sequence[OnlineResult],
    lag: int,
    *occasion: str | int,
) -> Performance:
    """Let the robot follow a demonstration of a sequence, from the posture of its start place.

    Args:
        scene: Robot and caregiver.
        sequence: What is shown, for its start place.
        results: What the robot knows after every row, see `recognised_while_shown`.
        lag: Rows that it is behind; the performance is so many rows longer. With 0 it commands
            what it predicts.
        occasion: What its noise depends on.
    """
    rng = generator_for(scene.seed, "performance", *occasion, sequence.name)
    scene.body.reset(scene.postures[sequence.start], rng)
    trial = Trial(scene.body, scene.postures[sequence.start])
    trial.think(trial.sensed[0], results[0].potentials)
    for now in range(len(results) - 1 + lag):
        known = results[min(now, len(results) - 1)]
        row = now + 1 - lag  # of the demonstration
        expected = known.expected(row)
        trial.think(expected, known.potentials)
        trial.step(expected[scene.joints] if row > 0 else trial.commanded[-1])
    return trial.performance()


def followed(scene: Scene, learner: Learner, imitated: Sequence[Imitation]) -> list[Row]:
    """Follow demonstrations at every lag of the settings.

    Args:
        scene: Robot and caregiver.
        learner: What the robot has become.
        imitated: The same demonstrations, recognised and performed after the fact.

    Returns:
        A row per demonstration and lag.
    """
    rows: list[Row] = []
    for each in imitated:
        sequence, watched = each.sequence, each.watched
        results = recognised_while_shown(scene, learner, sequence.start, watched)
        after = path_error_cm(each.performance.path, watched.path)
        for lag in scene.settings.evaluation.online.lags:
            done = follow(scene, sequence, results, lag, "online")
            error = path_error_cm(done.path[lag:], watched.path)
            rows.append(
                {
                    "motion": sequence.name,
                    "lag": lag,
                    "imitation_error_cm": error,
                    "after_the_fact_error_cm": after,
                }
            )
    return rows
