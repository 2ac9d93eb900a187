"""Which motions are in which update, and their values: at hand, or read while others learn."""

from collections.abc import Sequence
from functools import lru_cache

import jax
import jax.numpy as jnp
import numpy as np
from jax.sharding import Mesh, NamedSharding, PartitionSpec, Sharding
from jaxtyping import Array, Int
from numpy import ndarray

from motionese.errors import SettingError
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.motions import Motions
from motionese.learning.training.updates import Order

UPDATES, ROWS = 100, 2**16
"""Updates and rows in one compiled call at most: between calls training can be stopped and kept."""


class Feed:
    """The motions of a training, update by update.

    Every epoch they are shuffled and dealt evenly to its updates. Where they do not come out even
    an update has an empty motion in place of one: all updates are of one shape.

    Attributes:
        updates: In one epoch.
        size: Motions in one update, empty ones included.
        count: All motions, those included that are empty.
        whole: All of them, where they are at hand; None where they are read when needed.
        spread: How an update's motions are spread over devices; None for one device.
    """

    def __init__(
        self,
        motions: Motions,
        batch: int,
        key: Array | None,
        padded_to: tuple[int, int] | None,
        devices: Sequence[jax.Device] | None,
    ) -> None:
        """Check and prepare; arguments as those of `train`, batch as `Training` has it."""
        if batch > len(motions):
            raise SettingError(
                f"batch must be at most the number of motions to learn, {len(motions)}, got {batch}"
            )
        self.updates = -(-len(motions) // batch) if batch else 1
        if key is None and self.updates > 1:
            raise SettingError("training in batches needs a key to shuffle by, got none")
        capacity, self._rows = padded_to or (len(motions), max(motions.lengths))
        shares = len(devices or ()) or 1
        of_one = capacity if self.updates == 1 else -(-len(motions) // self.updates)
        self.size = shares * -(-of_one // shares)
        uneven = self.updates > 1 and self.size * self.updates > len(motions)
        self.count = max(capacity, len(motions) + uneven, self.size if self.updates == 1 else 0)
        self.spread: Sharding | None = None
        if shares > 1:
            mesh = Mesh(np.array(devices), ("motions",))
            self.spread = NamedSharding(mesh, PartitionSpec("motions"))  # type: ignore[no-untyped-call]
        at_hand = self.updates == 1 or not motions.stored
        self.whole = motions.batch(self._rows, self.count) if at_hand else None
        self._motions = motions
        self._key = jax.random.split(jax.random.key(0) if key is None else key)[0]
        self.part = lru_cache(maxsize=2)(self._part)
        self._shuffled = lru_cache(maxsize=2)(self._dealt)

    @property
    def length(self) -> int:
        """Updates in one compiled call at most."""
        return min(max(ROWS // (self.size * self._rows), 1), UPDATES)

    def _part(self, first: int, length: int) -> tuple[Batch, Order | None]:
        """Return what some updates take: all motions, or theirs, and which are in which."""
        if self.updates == 1:
            assert self.whole is not None, "whatever is learned at once is at hand"
            return self.whole, None
        numbers = range(first, first + length)
        order = np.stack([self._shuffled(n // self.updates)[n % self.updates] for n in numbers])
        if self.whole is not None:
            return self.whole, Order(*map(jnp.asarray, (order, order)))
        there = order < len(self._motions)
        places = np.where(there, np.cumsum(there).reshape(order.shape) - 1, order.size - 1)
        read = self._motions.chosen(order[there].tolist()).batch(self._rows, order.size)
        return read, Order(*map(jnp.asarray, (places, order)))

    def _dealt(self, epoch: int) -> Int[ndarray, "U M"]:
        """Return the motions of every update of an epoch; empty ones have the number after all."""
        motions = np.asarray(_permutation(jax.random.fold_in(self._key, epoch), len(self._motions)))
        dealt = np.full((self.updates, self.size), len(self._motions))
        for row, own in zip(dealt, np.array_split(motions, self.updates), strict=True):
            row[: len(own)] = own
        return dealt


_permutation = jax.jit(jax.random.permutation, static_argnums=1)
