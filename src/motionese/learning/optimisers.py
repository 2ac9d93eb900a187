"""Update rules of training and recognition, from optax."""

from functools import lru_cache
from typing import NamedTuple

import optax

from motionese.learning.parameters import PARAMETERS
from motionese.learning.settings import Optimiser, Schedule, Training

SLOWER, SLOWER_FROM = 0.3, 0.7
"""Recognition's rate is multiplied by the first after this share of its iterations."""
WARM_UP, BEGIN, END = 0.05, 0.1, 0.01
"""The cosine schedule rises over this share of the epochs; its first and last rate, as shares."""


class _Rule(NamedTuple):
    """Those settings of training that the update rule is made of."""

    optimiser: Optimiser
    weight_rate: float
    initial_rate: float
    schedule: Schedule
    momentum: float
    clip: float


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
    settings: _Rule, epochs: int, learned: tuple[str, ...]
) -> optax.GradientTransformation:
    rates = {name: PARAMETERS[name].rate for name in learned}
    by_rate = {
        rate: update_rule(
            settings.optimiser,
            _schedule(settings.schedule, getattr(settings, rate), epochs),
            settings.momentum,
        )
        for rate in dict.fromkeys(rates.values())
    }
    clip = [optax.clip_by_global_norm(settings.clip)] if settings.clip else []
    return optax.chain(*clip, optax.multi_transform(by_rate, rates))


def training_rule(settings: Training, learned: tuple[str, ...]) -> optax.GradientTransformation:
    """Return equations (4) and (5): every parameter moves at its rate of the table, one joint clip.

    Equal settings give the same object, so that compiled code is found again.
    """
    rule = _Rule(**{name: getattr(settings, name) for name in _Rule._fields})
    return _training_rule(rule, settings.epochs if settings.schedule == "cosine" else 0, learned)


@lru_cache(maxsize=64)
def recognition_rule(
    name: Optimiser, rate: float, momentum: float, iterations: int
) -> optax.GradientTransformation:
    """Return the update rule of recognition, whose rate falls towards the end."""
    falling = optax.piecewise_constant_schedule(rate, {round(SLOWER_FROM * iterations): SLOWER})
    return update_rule(name, falling, momentum)
