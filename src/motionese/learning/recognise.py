"""Recognition: the weights frozen, the initial states of an observed motion found by descent.

Of each motion any channels may be observed at any steps. The descent starts from several initial
states at once: recalled ones of learned motions, those given, and random ones. The one that ends
with the smallest error is kept, or that which first comes as near as motions were learned.
"""

from dataclasses import replace
from math import isclose

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float
from numpy import ndarray

from motionese.channels import Channels
from motionese.errors import ChannelError, SettingError
from motionese.learning.carried import carried
from motionese.learning.descent import descend
from motionese.learning.fit import Fit
from motionese.learning.found import Found, judged
from motionese.learning.motions import Motions
from motionese.learning.optimisers import recognition_rule
from motionese.learning.recall import Recalled, recalled
from motionese.learning.settings import Recognition
from motionese.network import MTRNN

SAME_RATE = 1e-3
"""Share by which rates may differ and count as the same."""


def recognise(
    model: MTRNN | Fit,
    motion: Motions | Float[ndarray, "T D"],
    *,
    observed: list[str] | None = None,
    rows: slice | None = None,
    starts: Float[ndarray, "M N"] | None = None,
    settings: Recognition | None = None,
    key: Array | None = None,
) -> Found:
    """Find the initial states from which the network generates a motion.

    Args:
        model: What training left; or a trained network alone, which has no memory of its motions
            to start from, and can recognise few hidden channels.
        motion: One motion, or its values [T, D] in the channels' units; what is not looked at may
            be anything, NaN included.
        observed: Names of the channels that are looked at; all if left out.
        rows: The stretch of time that is looked at; all if left out. Row 0 stays the time of u_0.
        starts: Initial states to start from beside the recalled and the random ones.
        settings: Iterations, starts, rate, bounds.
        key: JAX random key of the random starts; `jax.random.key(0)` where left out.
    """
    network = model.network if isinstance(model, Fit) else model
    if not isinstance(motion, Motions):
        if network.channels is None:
            raise ChannelError("the network carries no channels; give the motion as Motions")
        values = np.array(motion, dtype=np.float64, ndmin=1)
        seen = _looked_at(len(values), network.channels, observed, rows)
        rate = model.rate_hz if isinstance(model, Fit) else 1.0
        motion = Motions.from_arrays([values], network.channels, rate, observed=[seen])
    if len(motion) != 1:
        raise SettingError(f"recognise takes one motion, got {len(motion)}; see recognise_all")
    seen = motion.observed[0] & _looked_at(motion.lengths[0], motion.channels, observed, rows)
    motion = replace(motion, observed=(seen,))
    given = None if starts is None else np.asarray(starts)[None]
    return recognise_all(model, motion, starts=given, settings=settings, key=key)[0]


def _looked_at(
    length: int, channels: Channels, observed: list[str] | None, rows: slice | None
) -> Bool[ndarray, "T D"]:
    mask = np.zeros((length, len(channels)), dtype=bool)
    columns = channels.indices(channels.names if observed is None else observed)
    mask[slice(None) if rows is None else rows, columns] = True
    return mask


def recognise_all(
    model: MTRNN | Fit,
    motions: Motions,
    *,
    starts: Float[ndarray, "S M N"] | None = None,
    settings: Recognition | None = None,
    key: Array | None = None,
    padded_to: tuple[int, int] | None = None,
) -> list[Found]:
    """Recognise many motions in one batch, each from its observed values alone.

    Args:
        model: What training left, or a trained network alone; see `recognise`.
        motions: The motions; their masks say what is looked at.
        starts: Initial states to start from, so many for every motion.
        settings: Iterations, starts, rate, bounds.
        key: JAX random key of the random starts; `jax.random.key(0)` where left out.
        padded_to: Motions and rows to pad the batch to, so that different batches share compiled
            code.

    Raises:
        SettingError: Starts of another shape, channels or levels that the network does not have,
            or another rate than the fit's.
    """
    settings = settings or Recognition()
    if isinstance(model, Fit) and not isclose(motions.rate_hz, model.rate_hz, rel_tol=SAME_RATE):
        raise SettingError(
            f"the motions have {motions.rate_hz:g} rows a second, "
            f"the model was trained at {model.rate_hz:g}"
        )
    network, motions = carried(model.network if isinstance(model, Fit) else model, motions)
    if starts is not None and starts.shape[::2] != (len(motions), network.size):
        raise SettingError(
            f"starts must have shape [{len(motions)} motions, any number, {network.size} units], "
            f"got {starts.shape}"
        )
    count, rows = padded_to or (len(motions), max(motions.lengths))
    batch = motions.batch(rows, count)
    memory = recalled(model, batch) if isinstance(model, Fit) and model.names else None
    if starts is None and memory is None and not settings.starts:
        starts = np.zeros((len(motions), 1, network.size))
    free = _starts(network, count, starts, memory, settings, key)
    states, losses, chosen = descend(
        network,
        batch,
        free,
        network.per_unit(settings.bound, jnp.inf),
        recognition_rule(settings.optimiser, settings.rate, settings.momentum, settings.iterations),
        jnp.asarray(settings.penalty),
        settings.iterations,
        None if memory is None else _enough(memory, free.shape[1]),
    )
    return judged(
        network,
        motions,
        batch,
        np.asarray(states),
        np.asarray(losses),
        np.asarray(chosen),
        settings,
    )


def _enough(memory: Recalled, starts: int) -> Float[Array, "S M"]:
    """Return for every start, the recalled ones first, the loss that is small enough."""
    others = np.repeat(memory.typical[:, None], starts - memory.enough.shape[1], axis=1)
    return jnp.asarray(np.hstack([memory.enough, others]), float)


def _starts(
    network: MTRNN,
    count: int,
    given: Float[ndarray, "G H N"] | None,
    memory: Recalled | None,
    settings: Recognition,
    key: Array | None,
) -> Float[Array, "S M N"]:
    dtype = network.weights.dtype
    key = jax.random.key(0) if key is None else key
    parts = [] if memory is None else [jnp.asarray(memory.starts, dtype)]
    if given is not None:
        idle = count - len(given)
        parts.append(jnp.pad(jnp.asarray(given, dtype), ((0, idle), (0, 0), (0, 0))))
    if settings.starts:
        # One key a motion, so that a motion's starts do not depend on what is recognised with it.
        keys = jax.vmap(lambda i: jax.random.fold_in(key, i))(jnp.arange(count))
        shape = (settings.starts, network.size)
        drawn = jax.vmap(lambda k: jax.random.normal(k, shape, dtype))(keys)
        parts.append(settings.spread * drawn)
    return jnp.concatenate(parts, axis=1)
