"""Training: equations (4) and (5), the weights by α and every motion's initial states by β."""

from collections.abc import Callable, Sequence
from pathlib import Path
from time import monotonic

from jax import Device
from jaxtyping import Array, Float
from numpy import ndarray

from motionese.arguments import refusing
from motionese.learning.fit import Fit
from motionese.learning.motions.motions import Motions
from motionese.learning.settings import Training
from motionese.learning.status import Progress
from motionese.learning.training.shared_states import Groups
from motionese.learning.training.trainer import make_trainer
from motionese.network import MTRNN

CHECKPOINT_EVERY_S = 5.0
"""A kill loses at most about so many seconds of training."""


@refusing()
def train(
    network: MTRNN | Fit,
    motions: Motions,
    *,
    epochs: int | None = None,
    settings: Training | None = None,
    initial_states: Float[ndarray, "S N"] | None = None,
    shared: Groups | None = None,
    validation: Motions | None = None,
    key: Array | None = None,
    padded_to: tuple[int, int] | None = None,
    progress: Callable[[Progress], None] | None = None,
    checkpoint: str | Path | None = None,
    devices: Sequence[Device] | None = None,
) -> Fit:
    """Train a network on motions: equations (3)–(5), of whatever `settings.learned` names.

    Held-out motions are recognised after every chunk of epochs, the weights frozen: their loss
    tells how well motions that were not learned fit the network.

    Args:
        network: Where to start from: a network, or what training left of one. A motion that the
            latter learned goes on from its initial states there; the optimiser's memory and the
            schedule of its rates begin anew.
        motions: What to learn.
        epochs: Overrides `settings.epochs`.
        settings: Rates, optimiser, bounds, noise.
        initial_states: Initial states of every motion to start from; where left out those of the
            motion called so in a fit that is gone on from, else 0.
        shared: By level, which group every motion belongs to: the motions of a group share their
            initial states of that level. Those of a level that is not named are every motion's own.
        validation: Motions held out.
        key: JAX random key of the state noise, and of the order of motions where an update is of
            some of them; needed where there is either.
        padded_to: Motions and rows to pad the batch to, so that different batches share compiled
            code.
        progress: Called between chunks of epochs: of a hundred updates, or of one epoch.
        checkpoint: Where training is kept every few seconds; if the file is there, training goes
            on from it, to the same bits as without a break. At the end it is left, and gives the
            same fit at once: whoever has saved the fit removes it.
        devices: Over which the motions of an update are spread, such as `jax.devices()`; JAX's
            usual one where left out. Sums of several are rounded otherwise than those of one.

    Raises:
        SettingError: Channels, a rate or initial states do not fit, an unknown level in bounds,
            noise or shared states, noise or batches without a key, no epochs, a batch of more
            motions than there are, or an error that the network has no variance for.
        StorageError: The checkpoint belongs to another training, or cannot be read.
    """
    trainer = make_trainer(
        network,
        motions,
        epochs,
        settings or Training(),
        initial_states,
        shared or {},
        validation,
        key,
        padded_to,
        devices,
    )
    state = trainer.beginning
    checkpoint = None if checkpoint is None else Path(checkpoint)
    origin = trainer.origin if checkpoint else {}
    if checkpoint and checkpoint.exists():
        state = state.resumed(checkpoint, origin)
    status, written = trainer.ended(state), monotonic()
    try:
        while status is None:
            state, status = trainer.advanced(state)
            if status and status.failed:
                break
            if progress and trainer.judges(state):
                progress(trainer.progress(state))
            if checkpoint and monotonic() - written > CHECKPOINT_EVERY_S:
                state.write(checkpoint, origin, trainer.epochs(state))
                written = monotonic()
    finally:
        if checkpoint and not (status and status.failed):
            state.write(checkpoint, origin, trainer.epochs(state))
    return trainer.fit(state, status)
