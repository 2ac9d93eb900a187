"""Recognition: the weights frozen, the initial states of an observed motion found by descent.

Of each motion any channels may be observed at any steps. The descent starts from several initial
states at once, those given and random ones, and the one that ends with the smallest error is kept.
"""

from dataclasses import dataclass, replace

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import optax
from jaxtyping import Array, Bool, Float
from numpy import ndarray

from motionese.channels import Channels
from motionese.errors import ChannelError, SettingError
from motionese.learning.carried import carried
from motionese.learning.generate import channel_errors, predicted
from motionese.learning.motions import Batch, Motions
from motionese.learning.objective import initial_potentials, predictions, squared_errors
from motionese.learning.optimisers import recognition_rule
from motionese.learning.settings import Recognition
from motionese.learning.status import Ending, Status
from motionese.network import MTRNN


@dataclass(frozen=True)
class Found:
    """What recognition found for one motion.

    Attributes:
        initial_state: u_0 of all levels. [N]
        path: The recognised motion in closed loop, all channels, in their units. [T, D]
        residual: Root mean squared error of every observed channel in its unit; NaN for a channel
            that was not observed. [D]
        error: The residual over the observed channels, as a share of their ranges.
        loss: Equation (3) over what was observed, and the penalty.
        start: Which start was the best, the given ones counted first.
        status: Recognised, not recognised, or diverged.
    """

    initial_state: Float[ndarray, " N"]
    path: Float[ndarray, "T D"]
    residual: Float[ndarray, " D"]
    error: float
    loss: float
    start: int
    status: Status


def recognise(
    network: MTRNN,
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
        network: A trained network.
        motion: One motion, or its values [T, D] in the channels' units; what is not looked at may
            be anything, NaN included.
        observed: Names of the channels that are looked at; all if left out.
        rows: The stretch of time that is looked at; all if left out. Row 0 stays the time of u_0.
        starts: Initial states to start from beside the random ones.
        settings: Iterations, starts, rate, bounds.
        key: JAX random key of the random starts; `jax.random.key(0)` where left out.
    """
    if not isinstance(motion, Motions):
        if network.channels is None:
            raise ChannelError("the network carries no channels; give the motion as Motions")
        values = np.array(motion, dtype=np.float64, ndmin=1)
        seen = _looked_at(len(values), network.channels, observed, rows)
        motion = Motions.from_arrays([values], network.channels, rate_hz=1.0, observed=[seen])
    if len(motion) != 1:
        raise SettingError(f"recognise takes one motion, got {len(motion)}; see recognise_all")
    seen = motion.observed[0] & _looked_at(motion.lengths[0], motion.channels, observed, rows)
    motion = replace(motion, observed=(seen,))
    given = None if starts is None else np.asarray(starts)[None]
    return recognise_all(network, motion, starts=given, settings=settings, key=key)[0]


def _looked_at(
    length: int, channels: Channels, observed: list[str] | None, rows: slice | None
) -> Bool[ndarray, "T D"]:
    mask = np.zeros((length, len(channels)), dtype=bool)
    columns = channels.indices(channels.names if observed is None else observed)
    mask[slice(None) if rows is None else rows, columns] = True
    return mask


def recognise_all(
    network: MTRNN,
    motions: Motions,
    *,
    starts: Float[ndarray, "S M N"] | None = None,
    settings: Recognition | None = None,
    key: Array | None = None,
    padded_to: tuple[int, int] | None = None,
) -> list[Found]:
    """Recognise many motions in one batch, each from its observed values alone.

    Args:
        network: A trained network.
        motions: The motions; their masks say what is looked at.
        starts: Initial states to start from, so many for every motion.
        settings: Iterations, starts, rate, bounds.
        key: JAX random key of the random starts; `jax.random.key(0)` where left out.
        padded_to: Motions and rows to pad the batch to, so that different batches share compiled
            code.

    Raises:
        SettingError: Starts of another shape, or channels or levels
            that the network does not have.
    """
    settings = settings or Recognition()
    network, motions = carried(network, motions)
    if starts is None and not settings.starts:
        starts = np.zeros((len(motions), 1, network.size))
    if starts is not None and starts.shape[::2] != (len(motions), network.size):
        raise SettingError(
            f"starts must have shape [{len(motions)} motions, any number, {network.size} units], "
            f"got {starts.shape}"
        )
    count, rows = padded_to or (len(motions), max(motions.lengths))
    batch = motions.batch(rows, count)
    free = _starts(network, count, starts, settings, jax.random.key(0) if key is None else key)
    bound = network.per_unit(settings.bound, jnp.inf)
    rule = recognition_rule(
        settings.optimiser, settings.rate, settings.momentum, settings.iterations
    )
    states, losses = _descend(
        network, batch, free, bound, rule, jnp.asarray(settings.penalty), settings.iterations
    )
    return _judged(network, motions, batch, np.asarray(states), np.asarray(losses), settings)


def _starts(
    network: MTRNN,
    count: int,
    given: Float[ndarray, "G H N"] | None,
    settings: Recognition,
    key: Array,
) -> Float[Array, "S M N"]:
    dtype = network.weights.dtype
    parts = []
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


_Descent = tuple[Array, optax.OptState, Array, Array]
"""States, the update rule's memory, the best states so far and their loss."""


@eqx.filter_jit
def _descend(
    network: MTRNN,
    batch: Batch,
    free: Float[Array, "S M N"],
    bound: Float[Array, " N"],
    rule: optax.GradientTransformation,
    penalty: Float[Array, ""],
    iterations: int,
) -> tuple[Float[Array, "S N"], Float[Array, "S M"]]:
    """Descend from every start; return the best start's states and every start's loss.

    Only the gradient of the initial states is asked for, so that of the weights is never computed.
    """
    motions, starts, units = free.shape
    repeated = Batch(*(jnp.repeat(a, starts, axis=0) for a in batch))

    def losses(states: Array) -> Array:
        predicted = predictions(network, repeated, states, 0.0)
        context = states[:, network.io_size :]
        return squared_errors(predicted, repeated) + penalty * (context**2).sum(-1)

    def total(states: Array) -> tuple[Array, Array]:
        each = losses(states)
        return each.sum(), each

    def iteration(carry: _Descent, _: None) -> tuple[_Descent, None]:
        states, memory, best, best_loss = carry
        (_, each), slope = jax.value_and_grad(total, has_aux=True)(states)
        better = each < best_loss
        best = jnp.where(better[:, None], states, best)
        updates, memory = rule.update(slope, memory)
        states = jnp.clip(optax.apply_updates(states, updates), -bound, bound)
        return (states, memory, best, jnp.where(better, each, best_loss)), None

    flat = jnp.clip(free.reshape(-1, units), -bound, bound)
    begin = (flat, rule.init(flat), flat, jnp.full(len(flat), jnp.inf, flat.dtype))
    (states, _, best, best_loss), _ = jax.lax.scan(iteration, begin, None, length=iterations)
    last = losses(states)
    best = jnp.where((last < best_loss)[:, None], states, best).reshape(motions, starts, units)
    by_start = jnp.fmin(last, best_loss).reshape(motions, starts)
    chosen = jnp.take_along_axis(best, by_start.argmin(1)[:, None, None], axis=1)[:, 0]
    return initial_potentials(network, batch, chosen), by_start


def _judged(
    network: MTRNN,
    motions: Motions,
    batch: Batch,
    states: Float[ndarray, "S N"],
    losses: Float[ndarray, "S M"],
    settings: Recognition,
) -> list[Found]:
    paths = predicted(network, batch, states, 0.0)
    residuals = channel_errors(paths, batch, motions.channels)
    ranges = np.array([c.high - c.low for c in motions.channels])
    found = []
    for i, length in enumerate(motions.lengths):
        shares = residuals[i][~np.isnan(residuals[i])] / ranges[~np.isnan(residuals[i])]
        worst = float(shares.max()) if len(shares) else np.nan
        found.append(
            Found(
                initial_state=states[i],
                path=motions.channels.from_unit(paths[i, :length]),
                residual=residuals[i],
                error=float(np.sqrt((shares**2).mean())) if len(shares) else np.nan,
                loss=float(losses[i].min()),
                start=int(losses[i].argmin()),
                status=_verdict(float(losses[i].min()), worst, settings),
            )
        )
    return found


def _verdict(loss: float, worst: float, settings: Recognition) -> Status:
    if not np.isfinite(loss):
        return Status(Ending.DIVERGED, "no start kept a finite error")
    if np.isnan(worst):
        return Status(Ending.NOT_RECOGNISED, "nothing was observed after the first row")
    told = f"largest residual {worst:.1%} of a channel's range, allowed {settings.tolerance:.1%}"
    return Status(Ending.RECOGNISED if worst <= settings.tolerance else Ending.NOT_RECOGNISED, told)
