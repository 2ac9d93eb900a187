"""Update rules of training and recognition, from optax."""

from functools import lru_cache

import jax
import optax

from motionese.learning.parameters import PARAMETERS
from motionese.learning.settings import Optimiser, Schedule, Training

SLOWER, SLOWER_FROM = 0.3, 0.7
"""Recognition's rate is multiplied by the first after this share of its iterations."""
WARM_UP, BEGIN, END = 0.05, 0.1, 0.01
"""The cosine schedule rises over this share of the updates; its first and last rate, as shares."""


def update_rule(
    name: Optimiser, rate: float | optax.Schedule, momentum: float
) -> optax.GradientTransformation:
    """Return plain descent, descent with momentum, or Adam, at one rate or one that changes."""
    if name == "adam":
        return optax.adam(rate)
    return optax.sgd(rate, momentum if name == "momentum" else None)


def _schedule(name: Schedule, rate: float, updates: int) -> float | optax.Schedule:
    if name == "constant":
        return rate
    return optax.warmup_cosine_decay_schedule(
        BEGIN * rate, rate, round(WARM_UP * updates), updates, END * rate
    )


def _of_each(rule: optax.GradientTransformation) -> optax.GradientTransformation:
    """Return a rule that remembers of every value of [S, N] on its own how often it was updated."""
    init, update = (jax.vmap(jax.vmap(function)) for function in (rule.init, rule.update))
    return optax.GradientTransformation(
        init, lambda gradient, memory, _=None: update(gradient, memory)
    )


@lru_cache(maxsize=64)
def _training_rule(
    learned: tuple[str, ...],
    updates: int,
    some: bool,
    optimiser: Optimiser,
    schedule: Schedule,
    momentum: float,
    clip: float,
    **rates: float,
) -> optax.GradientTransformation:
    rate_of = {name: PARAMETERS[name].rate for name in learned}
    scheduled = {rate: _schedule(schedule, rates[rate], updates) for rate in rate_of.values()}
    by_rate = {rate: update_rule(optimiser, scheduled[rate], momentum) for rate in scheduled}
    if some and "initial_rate" in scheduled:
        own, rate = _of_each(update_rule(optimiser, 1.0, momentum)), scheduled["initial_rate"]
        scale = optax.scale_by_schedule(rate) if callable(rate) else optax.scale(rate)
        by_rate["initial_rate"] = optax.chain(own, scale)
    clipped = [optax.clip_by_global_norm(clip)] if clip else []
    return optax.chain(*clipped, optax.multi_transform(by_rate, rate_of))


def training_rule(
    settings: Training, learned: tuple[str, ...], updates: int = 1
) -> optax.GradientTransformation:
    """Return equations (4) and (5): every parameter moves at its rate of the table, one joint clip.

    Equal settings give the same object, so that compiled code is found again.

    Args:
        settings: Rates, schedule, optimiser.
        learned: What is learned, by the names of `PARAMETERS`.
        updates: In one epoch. Where there are several, each of some motions, the rule remembers of
            every motion's initial states how often they were updated.
    """
    total = settings.epochs * updates if settings.schedule == "cosine" else 0
    own = {"optimiser", "schedule", "momentum", "clip", "weight_rate", "initial_rate"}
    return _training_rule(learned, total, updates > 1, **settings.model_dump(include=own))


@lru_cache(maxsize=64)
def recognition_rule(
    name: Optimiser, rate: float, momentum: float, iterations: int
) -> optax.GradientTransformation:
    """Return the update rule of recognition, whose rate falls towards the end."""
    falling = optax.piecewise_constant_schedule(rate, {round(SLOWER_FROM * iterations): SLOWER})
    return update_rule(name, falling, momentum)
