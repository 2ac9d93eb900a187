"""All that training can move, as a table: where it lies, at which rate it moves, and how.

A parameter moves as free values, which may be any numbers. Weights, bias, read-outs and initial
states are their own free values. A time constant is not: it stays above one step, and what is
learned is by how much all units of a level become slower or faster (a level's units share one time
scale in the papers; a single unit's τ is hardly told apart from its weights):

    τ_i = 1 + (τ_i,0 − 1) e^θ,  one θ a level, 0 at first.

A step of θ is a share of τ − 1, for a fast level and for a slow one alike; a τ of 1 stays 1.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import equinox as eqx
import jax.numpy as jnp
import numpy as np
from jaxtyping import Array, Float

from motionese.network import MTRNN


class Parameters(eqx.Module):
    """What training moves: a network and the initial states of its motions, see `PARAMETERS`.

    Attributes:
        network: The network.
        initial_states: Of every motion, all levels; see `initial_potentials`. [S, N]
    """

    network: MTRNN
    initial_states: Float[Array, "S N"]

    def free(self, names: tuple[str, ...]) -> dict[str, Any]:
        """Return the free values of parameters as they are now."""
        return {name: PARAMETERS[name].free(self) for name in names}

    def moved(self, free: Mapping[str, Any]) -> "Parameters":
        """Return what this becomes with other free values of some parameters."""
        moved = self
        for name, values in free.items():
            row = PARAMETERS[name]
            moved = eqx.tree_at(row.place, moved, row.value(self, values))
        return moved


def _stretched(start: Parameters, free: Array) -> Array:
    sizes = np.array(start.network.sizes)
    return 1 + (start.network.tau - 1) * jnp.exp(jnp.repeat(free, sizes))


@dataclass(frozen=True)
class Parameter:
    """A row of the table.

    Attributes:
        place: Where it lies.
        rate: The setting that is its rate.
        own: Its free values where they are not itself, before it has moved.
        value: Its value, from where it was before it moved and its free values.
        present: Whether a network has it, to be learned.
    """

    place: Callable[[Parameters], Any]
    rate: Literal["weight_rate", "initial_rate"] = "weight_rate"
    own: Callable[[Parameters], Any] | None = None
    value: Callable[[Parameters, Any], Any] = lambda start, free: free
    present: Callable[[MTRNN], bool] = lambda network: True

    def free(self, start: Parameters) -> Any:
        """Return its free values before it has moved."""
        return (self.own or self.place)(start)


PARAMETERS = {
    "weights": Parameter(lambda now: now.network.weights),
    "bias": Parameter(lambda now: now.network.bias, present=lambda network: network.learned_bias),
    "tau": Parameter(
        lambda now: now.network.tau,
        own=lambda now: jnp.zeros(len(now.network.sizes), now.network.tau.dtype),
        value=_stretched,
    ),
    "variance": Parameter(
        lambda now: (now.network.variance_weights, now.network.variance_bias),
        present=lambda network: network.variance,
    ),
    "initial_states": Parameter(lambda now: now.initial_states, rate="initial_rate"),
}
"""Everything that training can move, by the names of `Training.learned`."""


def learned_by(network: MTRNN, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return which of these parameters a network has."""
    return tuple(name for name in names if PARAMETERS[name].present(network))
