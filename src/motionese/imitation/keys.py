"""Random keys by name: what is random in a run depends on its seed and on what it is for alone.

The same seed gives the same demonstrations in every condition, so that conditions can be compared
in pairs; and a run that goes on from a checkpoint needs no random state from before.
"""

import zlib

import jax
import numpy as np
from jaxtyping import Array


def key_for(seed: int, *purpose: str | int) -> Array:
    """Return the JAX key of a purpose, such as `("recognition", loop)`."""
    key = jax.random.key(seed)
    for part in purpose:
        number = part if isinstance(part, int) else zlib.crc32(part.encode())
        key = jax.random.fold_in(key, number)
    return key


def generator_for(seed: int, *purpose: str | int) -> np.random.Generator:
    """Return the NumPy generator of a purpose."""
    return np.random.default_rng(np.asarray(jax.random.key_data(key_for(seed, *purpose))))
