"""Motions judged piece by piece, so that of very many no more than few are in memory at once."""

from collections.abc import Iterable, Sequence

import jax.numpy as jnp
import numpy as np
from jaxtyping import Float
from numpy import ndarray

from motionese.learning.accuracy import errors_of
from motionese.learning.fit import Fit
from motionese.learning.motions.batch import Batch
from motionese.learning.motions.motions import Motions
from motionese.learning.objective import initial_potentials
from motionese.learning.recognition.recognise import recognise_all
from motionese.learning.recognition.result import RecognitionResult
from motionese.learning.settings import Recognition
from motionese.network import MTRNN

RECOGNISED = 2**14
"""Rows that are recognised together at most: every one is held for several starts."""


def errors_by_share(
    network: MTRNN,
    pieces: Iterable[tuple[range, Batch]],
    initial: Float[ndarray, "S N"],
    shares: Sequence[float],
) -> list[Float[ndarray, "M _"]]:
    """Return motions' u_0, and their errors with each of some shares of teacher forcing."""
    found = []
    for which, batch in pieces:
        idle = len(batch.sensed) - len(which)
        free = jnp.asarray(np.pad(initial[which], ((0, idle), (0, 0))), network.weights.dtype)
        errors = (errors_of(network, batch, free, share) for share in shares)
        parts = [np.asarray(initial_potentials(network, batch, free)), *errors]
        found.append([part[: len(which)] for part in parts])
    return [np.concatenate(part) for part in zip(*found, strict=True)]


def recognised(
    model: MTRNN | Fit,
    motions: Motions,
    starts: Float[ndarray, "S 1 N"] | None = None,
    settings: Recognition | None = None,
) -> list[RecognitionResult]:
    """Return what `recognise_all` does."""
    found: list[RecognitionResult] = []
    for which, padded_to in motions.pieces(RECOGNISED):
        own, some = None if starts is None else starts[which], motions.chosen(which)
        found += recognise_all(model, some, starts=own, settings=settings, padded_to=padded_to)
    return found
