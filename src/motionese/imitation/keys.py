"""Random keys by name: what is random in a run depends on its seed and on what it is for alone.

The same seed gives the same demonstrations in every condition, so that conditions can be compared
in pairs; and a run that goes on from a checkpoint needs no random state from before.
"""

import zlib
from functools import reduce

import jax
import numpy as np
from jaxtyping import Array, UInt32


def key_for(seed: int, *purpose: str | int) -> Array:
    """Return the JAX key of a purpose, such as `("recognition", loop)`."""
    numbers = [p if isinstance(p, int) else zlib.crc32(p.encode()) for p in purpose]
    key: Array = _folded(jax.random.key(seed), np.array(numbers, dtype=np.uint32))
    return key


@jax.jit
def _folded(key: Array, numbers: UInt32[Array, " P"]) -> Array:
    return reduce(jax.random.fold_in, numbers, key)


def generator_for(seed: int, *purpose: str | int) -> np.random.Generator:
    """Return the NumPy generator of a purpose."""
    return np.random.default_rng(np.asarray(jax.random.key_data(key_for(seed, *purpose))))
