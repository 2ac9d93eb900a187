"""Update rules of training and recognition, from optax."""

from functools import lru_cache

import optax

from motionese.learning.parameters import PARAMETERS
from motionese.learning.settings import Optimiser, Schedule, Training

SLOWER, SLOWER_FROM = 0.3, 0.7
"""Recognition's rate is multiplied by the first after this share of its iterations."""
WARM_UP, BEGIN, END = 0.05, 0.1, 0.01
"""The cosine schedule rises over this share of the epochs; its first and last rate, as shares."""


def update_rule(
    name: Optimiser, rate: float | optax.Schedule, momentum: float
) -> optax.GradientTransformation:
    """Return plain descent, descent with momentum, or Adam, at one rate or one that changes."""
    if name == "adam":
        return optax.adam(rate)
    return optax.sgd(rate, momentum if name == "momentum" else None)


def _schedule(name: Schedule, rate: float, epochs: int) -> float | optax.Schedule:
    if name == "constant":
        return rate
    return optax.warmup_cosine_decay_schedule(
        BEGIN * rate, rate, round(WARM_UP * epochs), epochs, END * rate
    )


@lru_cache(maxsize=64)
def _training_rule(
    learned: tuple[str, ...],
    epochs: int,
    optimiser: Optimiser,
    schedule: Schedule,
    momentum: float,
    clip: float,
    **rates: float,
) -> optax.GradientTransformation:
    rate_of = {name: PARAMETERS[name].rate for name in learned}
    by_rate = {
        rate: update_rule(optimiser, _schedule(schedule, rates[rate], epochs), momentum)
        for rate in dict.fromkeys(rate_of.values())
    }
    clipped = [optax.clip_by_global_norm(clip)] if clip else []
    return optax.chain(*clipped, optax.multi_transform(by_rate, rate_of))


def training_rule(settings: Training, learned: tuple[str, ...]) -> optax.GradientTransformation:
    """Return equations (4) and (5): every parameter moves at its rate of the table, one joint clip.

    Equal settings give the same object, so that compiled code is found again.
    """
    epochs = settings.epochs if settings.schedule == "cosine" else 0
    own = {"optimiser", "schedule", "momentum", "clip", "weight_rate", "initial_rate"}
    return _training_rule(learned, epochs, **settings.model_dump(include=own))


@lru_cache(maxsize=64)
def recognition_rule(
    name: Optimiser, rate: float, momentum: float, iterations: int
) -> optax.GradientTransformation:
    """Return the update rule of recognition, whose rate falls towards the end."""
    falling = optax.piecewise_constant_schedule(rate, {round(SLOWER_FROM * iterations): SLOWER})
    return update_rule(name, falling, momentum)
