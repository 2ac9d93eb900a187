"""Recognition as a nonlinear least-squares problem: damped Gauss–Newton steps of initial states.

Equation (3) is a sum of squared residuals r of a few dozen unknowns c, the free initial states.
With their Jacobian J from one scan forward (see `network.sensitivity`), a step solves

    (Jᵀ V J + p + λ / s²) Δc = −(Jᵀ V r + p c)   (Levenberg 1944, Marquardt 1963)

V being the weights of the residuals, p the penalty, s the paces at which levels move. A step that
makes the loss smaller is taken and λ falls; another is not, and λ rises. Steps stay short where
little is known, so that what is found stays near the start: near what the network has learned.
"""

from typing import NamedTuple

import equinox as eqx
import jax
import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from motionese.learning.error import error_of
from motionese.learning.objective import inputs
from motionese.learning.recognition.search import Found, Search
from motionese.network import read_out, sensitivities

FIRST_DAMPING = 1e-2
"""λ of the first step, as a share of the largest diagonal element of Jᵀ V J."""
BROAD = 8
"""Steps that are taken from every start, before only the best of every motion goes on."""
EASED, RAISED = 0.2, 5.0
"""λ is multiplied by the first after a step that was taken, by the second after another."""
LARGEST_DAMPING = 1e4
"""With a larger λ a step moves nothing any more."""
TINY = 1e-30
"""λ where nothing that is sought changes anything."""


class _Progress(NamedTuple):
    """How far the searches are.

    Attributes:
        sought: The initial states that are sought. [B, K]
        loss: Their loss. [B]
        curvature: Jᵀ V J + p there. [B, K, K]
        slope: Jᵀ V r + p c there. [B, K]
        damping: λ of the step that is tried, as a share of the largest diagonal element. [B]
        moving: Which are not at rest yet. [B]
        taken: Steps tried so far; −1 before the starts themselves were looked at. [B]
        tried: Where the next step leads, at first the starts. [B, K]
    """

    sought: Float[Array, "B K"]
    loss: Float[Array, " B"]
    curvature: Float[Array, "B K K"]
    slope: Float[Array, "B K"]
    damping: Float[Array, " B"]
    moving: Bool[Array, " B"]
    taken: Int[Array, " B"]
    tried: Float[Array, "B K"]


@eqx.filter_jit
def damped_steps(search: Search, iterations: int) -> Found:
    """Take damped steps, so many at most, and keep the best start of every motion.

    All starts take the first `BROAD` steps; only the best of every motion goes on. A single start
    takes them all.
    """
    starts = search.free.shape[1]
    first = iterations if starts == 1 else min(iterations, BROAD)
    broad = _taken(search, _begin(search), first)
    if first == iterations:
        return search.found(broad.sought, broad.loss, broad.taken)
    chosen = search.found(broad.sought, broad.loss, broad.taken).chosen
    best = jnp.arange(len(chosen)) * starts + chosen
    narrow = _taken(search.among(chosen), _Progress(*(part[best] for part in broad)), iterations)
    return search.found(
        broad.sought.at[best].set(narrow.sought),
        broad.loss.at[best].set(narrow.loss),
        broad.taken.at[best].set(narrow.taken),
    )


def _begin(search: Search) -> _Progress:
    begin = search.begin
    count, sought = begin.shape
    return _Progress(
        sought=begin,
        loss=jnp.full(count, jnp.inf, begin.dtype),
        curvature=jnp.zeros((count, sought, sought), begin.dtype),
        slope=jnp.zeros_like(begin),
        damping=jnp.full(count, FIRST_DAMPING, begin.dtype),
        moving=jnp.ones(count, bool),
        taken=jnp.full(count, -1),
        tried=begin,
    )


def _taken(search: Search, begin: _Progress, iterations: int) -> _Progress:
    """Return where damped steps lead: until there are so many, or nothing moves any more.

    The starts are looked at by the same code as what is tried later: it is large, and compiling it
    twice would take twice as long.
    """

    def step(now: _Progress) -> _Progress:
        loss, curvature, slope = normal_equations(search, now.tried)
        first = now.taken < 0
        tried = first | now.moving & search.short(now.loss)
        better = tried & (loss < now.loss)
        damping = now.damping * jnp.where(first, 1.0, jnp.where(better, EASED, RAISED))
        gained = now.loss - loss >= search.still * now.loss
        moving = first | tried & jnp.where(better, gained, damping <= LARGEST_DAMPING)
        then = _Progress(
            jnp.where(better[:, None], now.tried, now.sought),
            jnp.where(better, loss, now.loss),
            jnp.where(better[:, None, None], curvature, now.curvature),
            jnp.where(better[:, None], slope, now.slope),
            damping,
            moving,
            now.taken + tried,
            now.tried,
        )
        return then._replace(tried=_stepped(search, then))

    return jax.lax.while_loop(
        lambda now: (now.taken.max() < iterations) & search.unfinished(now.loss, now.moving),
        step,
        begin,
    )


def normal_equations(
    search: Search, sought: Float[Array, "B K"]
) -> tuple[Float[Array, " B"], Float[Array, "B K K"], Float[Array, "B K"]]:
    """Return the loss, Jᵀ V J + p and Jᵀ V r + p c (half of the loss's gradient).

    Where the network predicts variances, V are their inverses, held for the step.
    """
    network, batch, units = search.network, search.repeated, search.units
    start, sensed, share = inputs(network, batch, search.states(sought))
    potentials, jacobian = sensitivities(network, start, sensed, share, units)
    predicted = read_out(network, potentials)
    weight = batch.weight.at[:, 0].set(0.0)
    if predicted.variance is not None:
        weight = 0.5 * weight / predicted.variance
    # An IO unit that was sensed at first starts there, whatever was sought.
    context = units >= network.io_size
    at_first = batch.observed[:, 0, jnp.where(context, 0, units)] > 0
    jacobian = jnp.where((~context & at_first)[:, None, :, None], 0.0, jacobian)
    weighted = jacobian * weight[:, :, None]
    prior = search.penalty * context
    curvature = jnp.einsum("btkd,btld->bkl", weighted, jacobian) + jnp.diag(prior)
    slope = jnp.einsum("btkd,btd->bk", weighted, predicted.mean - sensed) + prior * sought
    return error_of(network)(predicted, batch) + search.prior(sought), curvature, slope


def _stepped(search: Search, now: _Progress) -> Float[Array, "B K"]:
    """Return where a damped step leads; what is at its bound and pushed beyond stays there."""
    limit = search.limit
    free = (jnp.abs(now.sought) < limit) | (now.sought * now.slope > 0)
    diagonal = jnp.diagonal(now.curvature, axis1=1, axis2=2).max(1)
    damping = jnp.maximum(now.damping * diagonal, TINY)
    damped = (
        now.curvature * (free[:, :, None] & free[:, None])
        + jnp.eye(len(limit)) / search.paces**2 * damping[:, None, None]
    )
    slope = jnp.where(free, now.slope, 0.0)
    change = jax.vmap(lambda a, b: jax.scipy.linalg.solve(a, b, assume_a="pos"))(damped, slope)
    return jnp.clip(now.sought - change, -limit, limit)
