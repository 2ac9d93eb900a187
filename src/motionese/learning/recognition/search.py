"""What recognition searches for: initial states of motions, from several starts each."""

from typing import NamedTuple

import jax.numpy as jnp
from jaxtyping import Array, Bool, Float, Int

from motionese.learning.motions.batch import Batch
from motionese.learning.objective import initial_potentials
from motionese.network import MTRNN


class Found(NamedTuple):
    """What a search came to.

    Attributes:
        states: The initial states that are kept of every motion. [S, N]
        losses: The loss of every start. [S, M]
        chosen: Which start was kept. [S]
    """

    states: Float[Array, "S N"]
    losses: Float[Array, "S M"]
    chosen: Int[Array, " S"]


class Search(NamedTuple):
    """The initial states that are searched for, of S motions from M starts each: B = S M searches.

    Attributes:
        network: The network, which stays as it is.
        batch: The motions.
        free: Initial states to start from. [S, M, N]
        units: Units whose initial states are sought; those of the others stay as given. [K]
        bound: Largest |u_0|. [N]
        penalty: Weight of Σ u_0² over the context units.
        enough: A start whose loss is as small as this stays where it is, and the start that came
            there first is kept (the discrepancy principle: to fit closer than the network knows
            its motions is to fit noise, at the cost of what was not observed). −∞ to go on for as
            long as it helps and keep the smallest loss. [S, M]
        still: Damped steps end where one makes the loss smaller by less than this share.
        paces: How readily each unit moves: a share of its updates in gradient descent; in damped
            steps a change of a tenth the pace costs a hundred times the damping. 1 if left out. [K]
    """

    network: MTRNN
    batch: Batch
    free: Float[Array, "S M N"]
    units: Int[Array, " K"]
    bound: Float[Array, " N"]
    penalty: Float[Array, ""]
    enough: Float[Array, "S M"]
    still: float | Float[Array, ""] = 1e-4
    paces: Float[Array, " K"] | float = 1.0

    @property
    def repeated(self) -> Batch:
        """The motions, each as often as it has starts."""
        return Batch(*(jnp.repeat(part, self.free.shape[1], axis=0) for part in self.batch))

    @property
    def limit(self) -> Float[Array, " K"]:
        """The bound of what is sought."""
        return self.bound[self.units]

    @property
    def begin(self) -> Float[Array, "B K"]:
        """What is sought, at the starts, within its bound."""
        return jnp.clip(self.states_of_starts[:, self.units], -self.limit, self.limit)

    @property
    def states_of_starts(self) -> Float[Array, "B N"]:
        """The initial states of all units at the starts."""
        return self.free.reshape(-1, self.free.shape[-1])

    def states(self, sought: Float[Array, "B K"]) -> Float[Array, "B N"]:
        """Return the initial states of all units with what is sought at these values."""
        return self.states_of_starts.at[:, self.units].set(sought)

    def prior(self, sought: Float[Array, "B K"]) -> Float[Array, " B"]:
        """Return what the penalty adds to the loss."""
        context = self.units >= self.network.io_size
        return self.penalty * (jnp.where(context, sought, 0.0) ** 2).sum(-1)

    def short(self, loss: Float[Array, " B"]) -> Bool[Array, " B"]:
        """Return which searches have not come near enough."""
        return ~(loss <= self.enough.reshape(-1))

    def unfinished(self, loss: Float[Array, " B"], moving: Bool[Array, " B"]) -> Bool[Array, ""]:
        """Return whether a motion of which no search has come near enough has one that moves."""
        short, moving = (a.reshape(self.enough.shape) for a in (self.short(loss), moving))
        return (short.all(1) & moving.any(1)).any()

    def among(self, chosen: Int[Array, " S"]) -> "Search":
        """Return the search that goes on from one start of every motion."""
        free, enough = (
            jnp.take_along_axis(part, chosen.reshape(-1, *[1] * (part.ndim - 1)), axis=1)
            for part in (self.free, self.enough)
        )
        return self._replace(free=free, enough=enough)

    def found(self, sought: Array, loss: Array, taken: Array) -> Found:
        """Return what is kept of the starts: what they came to, its loss, the steps it took."""
        by_start = loss.reshape(self.enough.shape)
        arrived = by_start <= self.enough
        first = jnp.where(arrived, taken.reshape(arrived.shape), taken.max() + 1).argmin(1)
        chosen = jnp.where(arrived.any(1), first, by_start.argmin(1))
        states = self.states(sought).reshape(self.free.shape)
        best = jnp.take_along_axis(states, chosen[:, None, None], axis=1)[:, 0]
        return Found(initial_potentials(self.network, self.batch, best), by_start, chosen)
