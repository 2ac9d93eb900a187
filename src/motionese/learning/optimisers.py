"""Update rules of training and recognition, from optax."""

from functools import lru_cache

import optax

from motionese.learning.settings import Optimiser, Training

SLOWER, SLOWER_FROM = 0.3, 0.7
"""Recognition's rate is multiplied by the first after this share of its iterations."""


def update_rule(
    name: Optimiser, rate: float | optax.Schedule, momentum: float
) -> optax.GradientTransformation:
    """Return plain descent, descent with momentum, or Adam, at one rate or one that changes."""
    if name == "adam":
        return optax.adam(rate)
    return optax.sgd(rate, momentum if name == "momentum" else None)


@lru_cache(maxsize=64)
def _training_rule(
    name: Optimiser, weights: float, initial: float, momentum: float, clip: float, bias: bool
) -> optax.GradientTransformation:
    # What is not learned is left out before the clip, whose norm it must not enlarge.
    fixed = {"weights": False, "bias": not bias, "initial": False}
    steps = [optax.masked(optax.set_to_zero(), fixed)]
    if clip:
        steps.append(optax.clip_by_global_norm(clip))
    by_group = {
        "weights": update_rule(name, weights, momentum),
        "initial": update_rule(name, initial, momentum),
    }
    groups = {"weights": "weights", "bias": "weights", "initial": "initial"}
    return optax.chain(*steps, optax.multi_transform(by_group, groups))


def training_rule(settings: Training, learned_bias: bool) -> optax.GradientTransformation:
    """Return equations (4) and (5): α for weights and bias, β for initial states, one joint clip.

    Equal settings give the same object, so that compiled code is found again.
    """
    return _training_rule(
        settings.optimiser,
        settings.weight_rate,
        settings.initial_rate,
        settings.momentum,
        settings.clip,
        learned_bias,
    )


@lru_cache(maxsize=64)
def recognition_rule(
    name: Optimiser, rate: float, momentum: float, iterations: int
) -> optax.GradientTransformation:
    """Return the update rule of recognition, whose rate falls towards the end."""
    falling = optax.piecewise_constant_schedule(rate, {round(SLOWER_FROM * iterations): SLOWER})
    return update_rule(name, falling, momentum)
