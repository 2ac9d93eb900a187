"""What every motion has of its own in a training: initial states, and the rule's memory of them.

A batch of some motions takes out what is theirs, updates it, and puts it back. What belongs to
motions that are not in it stays as it is, moments of Adam included; but members of a group that
share a level's states move along with those that are in it.
"""

from collections.abc import Callable, Mapping
from typing import TypeVar

import jax
import jax.numpy as jnp
from jaxtyping import Array, Float, Int

from motionese.network import MTRNN

OWN = {jax.tree_util.DictKey(name) for name in ("initial_states", "initial_rate")}
"""Under these keys stand values of initial states, [S, N], and what a rule remembers of them."""

State = TypeVar("State")


def taken(state: State, motions: Int[Array, " M"]) -> State:
    """Return the state of a training with what belongs to some motions alone."""
    return _changed(lambda values: values[motions], state)


def put_back(
    state: State,
    after: State,
    motions: Int[Array, " M"],
    network: MTRNN,
    shared: Mapping[str, Float[Array, "S S"]],
) -> State:
    """Return the state after an update of some motions.

    Args:
        state: The state before, of all motions.
        after: What was taken of it, updated.
        motions: Which were taken.
        network: For the units of its levels.
        shared: By level, see `averaging`.
    """
    groups = [(network.units(level), shares[:, motions] > 0) for level, shares in shared.items()]

    def put(values: Array, new: Array) -> Array:
        whole = values.at[motions].set(new)
        for units, members in groups:
            of_a_member = new[members.argmax(1)][:, units]
            moved = jnp.where(members.any(1)[:, None], of_a_member, values[:, units])
            whole = whole.at[:, units].set(moved)
        return whole

    return _changed(put, state, after)


def _changed(change: Callable[..., Array], state: State, *others: State) -> State:
    """Return the state with what belongs to motions changed; the rest is of the last one given."""

    def one(path: tuple[object, ...], *values: Array) -> Array:
        own = values[0].ndim == 2 and not OWN.isdisjoint(path)
        return change(*values) if own else values[-1]

    changed: State = jax.tree_util.tree_map_with_path(one, state, *others)
    return changed
