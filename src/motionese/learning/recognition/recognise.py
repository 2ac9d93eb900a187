"""Recognition: the weights frozen, the initial states of an observed motion found by descent.

Of each motion any channels may be observed at any steps. The descent starts from several initial
states at once: recalled ones of learned motions, those given, and random ones. The one that ends
with the smallest error is kept, or that which first comes as near as motions were learned.
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from functools import partial
from math import isclose

import jax
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Bool, Float, Int
from numpy import ndarray

from motionese.arguments import refusing
from motionese.channels import Channels
from motionese.errors import ChannelError, SettingError
from motionese.learning.fit import Fit
from motionese.learning.memory import Memory, Recall
from motionese.learning.motions.motions import Motions
from motionese.learning.objective import with_shared_channels
from motionese.learning.optimisers import recognition_rule
from motionese.learning.recognition.descent import descend
from motionese.learning.recognition.least_squares import damped_steps
from motionese.learning.recognition.result import RecognitionResult, judged
from motionese.learning.recognition.search import Found, Search
from motionese.learning.settings import Recognition
from motionese.network import MTRNN

SAME_RATE = 1e-3
"""Share by which rates may differ and count as the same."""

Model = MTRNN | Fit | tuple[MTRNN, Memory]
"""What training left, or a network with what it has learned, or a trained network alone."""


@refusing()
def recognise(
    model: Model,
    motion: Motions | Float[ndarray, "T D"],
    *,
    observed: Sequence[str | int] | str | int | None = None,
    rows: slice | None = None,
    starts: Float[ndarray, "M N"] | None = None,
    settings: Recognition | None = None,
    key: Array | None = None,
) -> RecognitionResult:
    """Find the initial states from which the network generates a motion.

    Args:
        model: What training left, or a network and its memory; or a trained network alone, which
            has no memory of its motions to start from, and can recognise few hidden channels.
        motion: One motion, or its values [T, D] in the channels' units; what is not looked at may
            be anything, NaN included.
        observed: Names or numbers of the channels that are looked at; all if left out.
        rows: The stretch of time that is looked at; all if left out. Row 0 stays the time of u_0.
        starts: Initial states to start from beside the recalled and the random ones.
        settings: Iterations, starts, rate, bounds.
        key: JAX random key of the random starts; `jax.random.key(0)` where left out.
    """
    network, _, rate = _parts(model)
    if not isinstance(motion, Motions):
        if network.channels is None:
            raise ChannelError("the network carries no channels; give the motion as Motions")
        values = np.array(motion, dtype=np.float64, ndmin=1)
        seen = _looked_at(len(values), network.channels, observed, rows)
        motion = Motions.from_arrays([values], network.channels, rate or 1.0, observed=[seen])
    if len(motion) != 1:
        raise SettingError(f"recognise takes one motion, got {len(motion)}; see recognise_all")
    seen = motion.observed[0] & _looked_at(motion.lengths[0], motion.channels, observed, rows)
    motion = replace(motion, observed=(seen,))
    given = None if starts is None else np.asarray(starts)[None]
    return recognise_all(model, motion, starts=given, settings=settings, key=key)[0]


def _looked_at(
    length: int,
    channels: Channels,
    observed: Sequence[str | int] | str | int | None,
    rows: slice | None,
) -> Bool[ndarray, "T D"]:
    mask = np.zeros((length, len(channels)), dtype=bool)
    columns = channels.indices(channels.names if observed is None else observed)
    mask[slice(None) if rows is None else rows, columns] = True
    return mask


@refusing()
def recognise_all(
    model: Model,
    motions: Motions,
    *,
    starts: Float[ndarray, "S M N"] | None = None,
    settings: Recognition | None = None,
    key: Array | None = None,
    padded_to: tuple[int, int] | None = None,
) -> list[RecognitionResult]:
    """Recognise many motions in one batch, each from its observed values alone.

    Args:
        model: What training left, a network and its memory, or a network alone; see `recognise`.
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
    network, memory, rate = _parts(model)
    if rate is not None and not isclose(motions.rate_hz, rate, rel_tol=SAME_RATE):
        raise SettingError(
            f"the motions have {motions.rate_hz:g} rows a second, the model was trained at {rate:g}"
        )
    network, motions = with_shared_channels(network, motions)
    if starts is not None and starts.shape[::2] != (len(motions), network.size):
        raise SettingError(
            f"starts must have shape [{len(motions)} motions, any number, {network.size} units], "
            f"got {starts.shape}"
        )
    count, rows = padded_to or (len(motions), max(motions.lengths))
    batch = motions.batch(rows, count)
    recall = None
    if memory is not None and memory.names:
        recall = memory.nearest(network, batch, settings.recalled)
    if starts is None and recall is None and not settings.starts:
        starts = np.zeros((len(motions), 1, network.size))
    free = _starts(network, count, starts, recall, settings, key)
    units = _sought(network, motions, settings)
    search = Search(
        network,
        batch,
        free,
        units,
        network.per_unit(settings.bound, jnp.inf),
        jnp.asarray(settings.penalty, free.dtype),
        _enough(memory, recall, count, free.shape[1]),
        jnp.asarray(settings.still, free.dtype),
        network.per_unit(settings.slower, 1.0)[units],
    )
    return judged(network, motions, batch, _found(search, settings), settings)


def _parts(model: Model) -> tuple[MTRNN, Memory | None, float | None]:
    """Return a model's network, and its memory and rate where they are known."""
    if isinstance(model, Fit):
        return model.network, model.memory, model.rate_hz
    network, memory = model if isinstance(model, tuple) else (model, None)
    return network, memory, None


def _found(search: Search, settings: Recognition) -> Found:
    if settings.optimiser == "least_squares":
        return damped_steps(search, settings.iterations)
    rule = recognition_rule(
        settings.optimiser, settings.rate, settings.momentum, settings.iterations
    )
    return descend(search, rule, settings.iterations)


def _sought(network: MTRNN, motions: Motions, settings: Recognition) -> Int[Array, " K"]:
    """Return the units whose initial states are sought: those of context levels, or of some.

    And those of IO that begin at nothing sensed, in any of the motions.
    """
    unsensed = ~np.all([mask[0] for mask in motions.observed], axis=0)
    io = np.flatnonzero(unsensed & (network.initial_io == "sensed"))
    levels = network.names[1:] if settings.levels is None else settings.levels
    return jnp.asarray(np.concatenate([io, _units(network, levels)]))


def _units(network: MTRNN, levels: Iterable[str]) -> Int[ndarray, " K"]:
    units = np.arange(network.size)
    return np.concatenate([units[network.units(name)] for name in levels])


def _enough(
    memory: Memory | None, recall: Recall | None, count: int, starts: int
) -> Float[Array, "S M"]:
    """Return for every start, the recalled ones first, the loss that is small enough.

    −∞ where nobody knows how well motions were learned.
    """
    if memory is None or recall is None or np.isnan(memory.errors).all():
        return jnp.full((count, starts), -jnp.inf)
    others = np.repeat(recall.typical[:, None], starts - recall.enough.shape[1], axis=1)
    return jnp.asarray(np.hstack([recall.enough, others]), float)


def _starts(
    network: MTRNN,
    count: int,
    given: Float[ndarray, "G H N"] | None,
    recall: Recall | None,
    settings: Recognition,
    key: Array | None,
) -> Float[Array, "S M N"]:
    dtype = network.weights.dtype
    key = jax.random.key(0) if key is None else key
    parts = [] if recall is None else [jnp.asarray(recall.starts, dtype)]
    if given is not None:
        idle = count - len(given)
        parts.append(jnp.pad(jnp.asarray(given, dtype), ((0, idle), (0, 0), (0, 0))))
    if settings.starts:
        drawn = settings.spread * _drawn(key, count, settings.starts, network.size, dtype)
        if settings.levels is not None and parts:
            held = jnp.isin(jnp.arange(network.size), _units(network, settings.levels), invert=True)
            drawn = jnp.where(held, parts[0][:, :1], drawn)
        parts.append(drawn)
    return jnp.concatenate(parts, axis=1)


@partial(jax.jit, static_argnums=(1, 2, 3, 4))
def _drawn(
    key: Array, motions: int, starts: int, units: int, dtype: jnp.dtype
) -> Float[Array, "S M N"]:
    """Draw from one key a motion: its starts do not depend on what is recognised with it."""
    keys = jax.vmap(lambda i: jax.random.fold_in(key, i))(jnp.arange(motions))
    return jax.vmap(lambda k: jax.random.normal(k, (starts, units), dtype))(keys)
